//! What can be wrong with a file.

use std::io;

/// Why a file is not read, or not read further. Messages name the byte and the record as far as they are known,
/// what was found and what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The system's reason.
    #[error("reading stopped: {0}")]
    Io(#[from] io::Error),
    /// The content contradicts its format.
    #[error("byte {at}: {what}")]
    Damaged {
        /// Where, bytes from the beginning.
        at: u64,
        /// What was found there.
        what: String,
    },
    /// The content is of the format and of no use, or there is too much of it.
    #[error("{0}")]
    Refused(String),
}

impl Error {
    /// Damage at byte `at`.
    pub fn at(at: u64, what: impl Into<String>) -> Self {
        Self::Damaged {
            at,
            what: what.into(),
        }
    }

    /// A refusal.
    pub fn refused(words: impl Into<String>) -> Self {
        Self::Refused(words.into())
    }
}
