//! Errors as exceptions with fields.

use pyo3::prelude::*;
use stillpoint::{Error, ErrorKind};

/// The exception of an error: of the class of its kind, with its fields.
pub fn exception(py: Python<'_>, error: &Error) -> PyErr {
    let made = py.import("stillpoint._errors").and_then(|module| {
        module.call_method1(
            "exception",
            (
                error.kind.name(),
                &error.message,
                error.file.as_deref(),
                error.line,
                error.column,
                error.next.as_deref(),
            ),
        )
    });
    made.map_or_else(|error| error, PyErr::from_value)
}

/// A call that is wrong.
pub fn usage(py: Python<'_>, message: String) -> PyErr {
    of_kind(py, ErrorKind::Usage, &message)
}

/// A bug of ours.
pub fn bug(py: Python<'_>, message: &str) -> PyErr {
    of_kind(py, ErrorKind::Bug, message)
}

fn of_kind(py: Python<'_>, kind: ErrorKind, message: &str) -> PyErr {
    let none: Option<&str> = None;
    let made = py.import("stillpoint._errors").and_then(|module| {
        module.call_method1("exception", (kind.name(), message, none, none, none, none))
    });
    made.map_or_else(|error| error, PyErr::from_value)
}
