//! Access to the bytes of a file, on disk or in memory.

use std::fs::File;
use std::io::{Cursor, Read, Seek};
use std::path::PathBuf;
use std::sync::Arc;

use crate::Error;

/// Storage of an archive or of a file of tables.
#[derive(Clone, Debug)]
pub(crate) enum Store {
    File(PathBuf),
    Memory(Arc<[u8]>),
}

pub(crate) trait Stored: Read + Seek + Send {}

impl<T: Read + Seek + Send> Stored for T {}

impl Store {
    pub fn open(&self) -> Result<Box<dyn Stored>, Error> {
        Ok(match self {
            Self::File(path) => Box::new(File::open(path)?),
            Self::Memory(bytes) => Box::new(Cursor::new(bytes.clone())),
        })
    }

    /// Bytes in it.
    #[cfg(any(feature = "parquet", feature = "hdf5"))]
    pub fn length(&self) -> Result<u64, Error> {
        Ok(match self {
            Self::File(path) => path.metadata()?.len(),
            Self::Memory(bytes) => bytes.len() as u64,
        })
    }
}
