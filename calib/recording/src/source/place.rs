//! How messages name the place they speak of.

use crate::Error;

/// An input error at `file: `.
pub(crate) fn in_file(name: &str, words: impl AsRef<str>) -> Error {
    Error::input(format!("{name}: {}", words.as_ref()))
}

/// An input error at `file:line: `.
pub(crate) fn at_line(name: &str, line: u64, words: impl AsRef<str>) -> Error {
    Error::input(format!("{name}:{line}: {}", words.as_ref()))
}

/// An input error at `file:line:column: `, the column counted in bytes from 1.
pub(crate) fn at_column(name: &str, line: u64, column: usize, words: impl AsRef<str>) -> Error {
    Error::input(format!("{name}:{line}:{column}: {}", words.as_ref()))
}
