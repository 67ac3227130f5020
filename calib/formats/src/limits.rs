//! Limits on what is read before a file is refused.

use findings::{Finding, Kind, Remedy};

use crate::Error;
use crate::error::counted;

/// Limits on what a file may ask for. Whatever it claims, memory grows only with what was read.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Bytes after decompression, of all entries together.
    pub bytes: u64,
    /// Entries of an archive.
    pub entries: usize,
    /// Bytes after decompression per byte before it, from 1 MiB on.
    pub ratio: u64,
    /// Samples of one sensor.
    pub rows: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            bytes: 4 << 30,
            entries: 10_000,
            ratio: 1000,
            rows: 200_000_000,
        }
    }
}

/// Bytes that may always come of compressed ones, however few those are.
const ALWAYS: u64 = 1 << 20;

impl Limits {
    /// An archive or a folder of more than [`Limits::entries`].
    pub(crate) fn too_many_entries(&self) -> Error {
        let found = Finding::of(Kind::ENTRIES_TOO_MANY).count("limit", self.entries);
        Error::refused(found.detail("things", "entries").remedy(Remedy::NameFile))
    }

    /// Refuses `large` bytes that `small` compressed ones unpack to.
    ///
    /// # Errors
    /// Both figures and the limit.
    pub fn check_unpacked(&self, what: &str, small: u64, large: u64) -> Result<(), Error> {
        if large > self.bytes {
            return Err(self.too_large(what));
        }
        if large > ALWAYS && large / self.ratio > small {
            let found = Finding::of(Kind::UNPACKS_TOO_MUCH).detail("what", what);
            return Err(Error::refused(counted(found, "ratio", self.ratio)));
        }
        Ok(())
    }

    /// Something that unpacks to more than [`Limits::bytes`].
    pub(crate) fn too_large(&self, what: &str) -> Error {
        let found = Finding::of(Kind::UNPACKS_TOO_LARGE).detail("what", what);
        Error::refused(counted(found, "limit", self.bytes))
    }
}
