//! How much is read before a file is refused.

use crate::Error;

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
    /// What is said of more than [`Limits::entries`].
    pub(crate) fn too_many_entries(&self) -> Error {
        Error::refused(format!(
            "more than {} entries, as no recording has; name the file itself",
            self.entries
        ))
    }

    /// Refuses `large` bytes that `small` compressed ones unpack to.
    ///
    /// # Errors
    /// Both figures and the limit.
    pub fn check_unpacked(&self, what: &str, small: u64, large: u64) -> Result<(), Error> {
        if large > self.bytes {
            return Err(Error::refused(format!(
                "{what} unpacks to more than {} bytes; unpack it yourself if you trust it, and name the file",
                self.bytes
            )));
        }
        if large > ALWAYS && large / self.ratio > small {
            return Err(Error::refused(format!(
                "{what} unpacks to more than {} times its size, as no recording does; unpack it yourself if you trust it",
                self.ratio
            )));
        }
        Ok(())
    }
}
