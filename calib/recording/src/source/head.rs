//! The beginning of a text.

use std::io::Read;

use findings::{Finding, Kind};

use super::place::in_file;
use crate::Error;

/// Up to `HEAD` bytes from the front of `reader`.
pub(crate) fn take_head(name: &str, reader: &mut dyn Read) -> Result<Vec<u8>, Error> {
    let mut head = Vec::new();
    let read = reader.take(HEAD).read_to_end(&mut head);
    read.map_err(|error| stopped(name, &error))?;
    Ok(head)
}

/// An error of the system in the middle of a file.
pub(super) fn stopped(name: &str, error: &std::io::Error) -> Error {
    let found = Finding::of(Kind::READING_STOPPED);
    in_file(name, found.detail("reason", error.to_string()))
}

/// Bytes of a text that are looked at before it is read, comments at its beginning not counted.
pub(super) const HEAD: u64 = 64 << 10;
