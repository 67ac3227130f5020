//! What can be wrong with a batch as a whole; what is wrong with a device is in its record.

use std::path::PathBuf;

/// A batch that cannot be run or merged.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A manifest that says what is none; the message begins with `file:line`.
    #[error("{0}")]
    Manifest(String),
    /// A file or folder that cannot be read.
    #[error("{path}: {source}", path = path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file or folder that cannot be written.
    #[error("{path}: cannot be written: {source}", path = path.display())]
    Output {
        /// Which.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Parts that do not make a whole.
    #[error("{} of the parts cannot be merged", .0.len())]
    Parts(Vec<crate::fault::Fault>),
    /// Too few devices for what was asked.
    #[error("{found} devices with {parameters} parameters in common; at least {needed} needed")]
    TooFew {
        /// Devices that have them.
        found: usize,
        /// Parameters.
        parameters: usize,
        /// Devices that would do.
        needed: usize,
    },
}

impl From<output::Error> for Error {
    fn from(error: output::Error) -> Self {
        Self::Output {
            path: error.path.clone(),
            source: error.into(),
        }
    }
}
