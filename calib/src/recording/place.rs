//! How messages name the place they speak of.

use std::fmt::Write;
use std::path::Path;

use crate::Error;

/// A name from outside, safe to print: control characters escaped, at most 200 characters.
pub(crate) fn shown(name: &str) -> String {
    let mut out = String::new();
    for (count, c) in name.chars().enumerate() {
        if count == 200 {
            out.push('…');
            break;
        }
        if c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}') {
            let _ = write!(out, "{}", c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

/// A path, safe to print.
pub(crate) fn shown_path(path: &Path) -> String {
    shown(&path.to_string_lossy())
}

/// An input error at `file: `.
pub(super) fn in_file(name: &str, words: impl AsRef<str>) -> Error {
    Error::Input(format!("{name}: {}", words.as_ref()))
}

/// An input error at `file:line: `.
pub(super) fn at_line(name: &str, line: u64, words: impl AsRef<str>) -> Error {
    Error::Input(format!("{name}:{line}: {}", words.as_ref()))
}

/// An input error at `file:line:column: `, the column counted in bytes from 1.
pub(super) fn at_column(name: &str, line: u64, column: usize, words: impl AsRef<str>) -> Error {
    Error::Input(format!("{name}:{line}:{column}: {}", words.as_ref()))
}
