//! The place of what is wrong with an input.

use findings::Finding;

use crate::Error;

/// An input error in a file.
pub(crate) fn in_file(name: &str, found: Finding) -> Error {
    Error::input(found.in_file(name))
}

/// An input error at a line, counted from 1.
pub(crate) fn at_line(name: &str, line: u64, found: Finding) -> Error {
    in_file(name, found.at_line(line))
}

/// An input error at a line and a column, counted in bytes from 1.
pub(crate) fn at_column(name: &str, line: u64, column: usize, found: Finding) -> Error {
    at_line(name, line, found.at_column(column as u64))
}
