//! JSON that cannot be read, with its place.

use findings::{Finding, Kind};
use recording::shown::shown;

/// A finding of JSON that cannot be read, where it stands.
pub fn of_json(kind: Kind, error: &serde_json::Error) -> Finding {
    let found = Finding::of(kind).detail("reason", shown(&error.to_string()));
    match error.line() {
        // Of a value there is no place.
        0 => found,
        line => found.at_line(line as u64).at_column(error.column() as u64),
    }
}
