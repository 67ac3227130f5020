//! A limit on what a compressed file may unpack to.

use std::io::{self, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use file_formats::Limits;

/// Counts what is read of a compressed file.
struct Packed {
    reader: Box<dyn Read + Send>,
    count: Arc<AtomicU64>,
}

impl Read for Packed {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.reader.read(buffer)?;
        self.count.fetch_add(read as u64, Ordering::Relaxed);
        Ok(read)
    }
}

/// The content of a compressed file, refused where it is too much for the file's size.
pub(crate) struct Bounded {
    content: Box<dyn Read + Send>,
    packed: Arc<AtomicU64>,
    count: u64,
}

impl Bounded {
    /// Builds a reader of `reader` through `decoder`.
    pub fn of(
        reader: Box<dyn Read + Send>,
        decoder: impl FnOnce(Box<dyn Read + Send>) -> Box<dyn Read + Send>,
    ) -> Self {
        let packed = Arc::new(AtomicU64::new(0));
        let count = packed.clone();
        Self {
            content: decoder(Box::new(Packed { reader, count })),
            packed,
            count: 0,
        }
    }
}

impl Read for Bounded {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.content.read(buffer)?;
        self.count += read as u64;
        let packed = self.packed.load(Ordering::Relaxed);
        // Text is read as it comes, so that its size does not matter.
        let limits = Limits {
            bytes: u64::MAX,
            ..Limits::default()
        };
        let checked = limits.check_unpacked("it", packed, self.count);
        checked.map_err(io::Error::other)?;
        Ok(read)
    }
}
