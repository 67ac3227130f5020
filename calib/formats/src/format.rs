//! A format, as data.

use std::io::{Cursor, Read, Seek};

use findings::{Finding, Kind};

use crate::error::counted;
use crate::{Content, Error, Limits, Wanted};

/// A format of binary or structured files.
#[derive(Debug)]
pub struct Format {
    /// The name to ask for it.
    pub name: &'static str,
    /// Description of the format in one line.
    pub about: &'static str,
    /// True of the first bytes of its files.
    pub(crate) begins: fn(&[u8]) -> bool,
    pub(crate) reads: Reads,
}

/// The ways in which streams of sensors come out of a file.
#[derive(Debug)]
pub(crate) enum Reads {
    /// From its begin to its end.
    Forward(fn(&mut dyn Read, &Wanted, Limits) -> Result<Content, Error>),
    /// From anywhere in it, so that what cannot be sought in is held in memory.
    Seeking(fn(&mut dyn ReadSeek, &Wanted, Limits) -> Result<Content, Error>),
}

impl Format {
    /// The streams of sensors in a file. One that is cut short gives what is there, and [`Content::cut`].
    ///
    /// # Errors
    /// Damage with its byte, or content beyond `limits`.
    pub fn read(
        &self,
        reader: &mut dyn Read,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error> {
        let read = match self.reads {
            Reads::Forward(read) => return read(reader, wanted, limits),
            Reads::Seeking(read) => read,
        };
        let mut bytes = Vec::new();
        reader
            .take(limits.bytes.saturating_add(1))
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > limits.bytes {
            let found = Finding::of(Kind::CONTENT_TOO_LARGE).detail("what", "a database");
            return Err(Error::refused(counted(found, "limit", limits.bytes)));
        }
        read(&mut Cursor::new(bytes), wanted, limits)
    }

    /// The same of what can be sought in, which some formats need not hold in memory.
    ///
    /// # Errors
    /// As [`Format::read`].
    pub fn read_seekable(
        &self,
        file: &mut dyn ReadSeek,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error> {
        match self.reads {
            Reads::Forward(read) => read(&mut &mut *file, wanted, limits),
            Reads::Seeking(read) => read(file, wanted, limits),
        }
    }
}

/// A reader with random access.
pub trait ReadSeek: Read + Seek {}
impl<T: Read + Seek> ReadSeek for T {}
