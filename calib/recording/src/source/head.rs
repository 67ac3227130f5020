//! The beginning of a text.

use std::io::Read;

use super::place::in_file;
use crate::Error;

/// Up to `HEAD` bytes from the front of `reader`.
pub(crate) fn take_head(name: &str, reader: &mut dyn Read) -> Result<Vec<u8>, Error> {
    let mut head = Vec::new();
    let read = reader.take(HEAD).read_to_end(&mut head);
    read.map_err(|error| in_file(name, format!("reading stopped: {error}")))?;
    Ok(head)
}

/// Bytes of a text that are looked at before it is read, comments at its beginning not counted.
pub(super) const HEAD: u64 = 64 << 10;
