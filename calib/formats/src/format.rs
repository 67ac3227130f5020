//! The trait that every format implements.

use std::fmt;
use std::io::{Read, Seek};

use crate::{Content, Error, Limits, Wanted};

/// A format of binary or structured files.
pub trait Format: fmt::Debug + Sync {
    /// The name to ask for it.
    fn name(&self) -> &'static str;

    /// Description of the format in one line.
    fn about(&self) -> &'static str;

    /// True if a file that begins with `head` is of this format.
    fn recognises(&self, head: &[u8]) -> bool;

    /// The streams of sensors in it. A file that is cut short gives what is there, and [`Content::cut`].
    ///
    /// # Errors
    /// Damage with its byte, or content beyond `limits`.
    fn read(
        &self,
        reader: &mut dyn Read,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error>;

    /// The same of what can be sought in, which some formats need not hold in memory.
    ///
    /// # Errors
    /// As [`Format::read`].
    fn read_seekable(
        &self,
        file: &mut dyn ReadSeek,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error> {
        self.read(&mut &mut *file, wanted, limits)
    }
}

/// A reader with random access.
pub trait ReadSeek: Read + Seek {}
impl<T: Read + Seek> ReadSeek for T {}
