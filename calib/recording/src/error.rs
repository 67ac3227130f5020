//! What can be wrong with recordings and calibrations.

use std::path::PathBuf;

use crate::shown::shown_path;

/// An input or a request that cannot be worked with. Messages name the place, what was found and
/// what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The request contradicts itself or lacks something.
    #[error("{0}")]
    Usage(String),
    /// A file cannot be read.
    #[error("{path}: {source}", path = shown_path(path))]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file cannot be written.
    #[error("{path}: cannot be written: {source}", path = shown_path(path))]
    Output {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file holds something that is no recording. The message begins with `file:line:column`.
    #[error("{0}")]
    Input(String),
    /// A file holds several recordings, of which one has to be chosen.
    #[error("{message}")]
    Parts {
        /// Where the second begins, and how to choose.
        message: String,
        /// How many there are.
        count: usize,
    },
    /// The recording does not determine the parameters.
    #[error("{0}")]
    NotEnough(String),
    /// The fit did not reach a minimum.
    #[error("{0}")]
    NotConverged(String),
    /// A watch ended the work ([`crate::watch`]).
    #[error("cancelled")]
    Cancelled,
    /// The solver refused the problem.
    #[error(transparent)]
    Solver(#[from] solver::Error),
}
