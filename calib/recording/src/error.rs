//! Errors that end a reading or a calibration: a finding, and the class that gives the exit status.

use std::path::{Path, PathBuf};

use findings::{Finding, Front, Kind};

use crate::shown::shown_path;

/// An input or a request that cannot be worked with.
///
/// The finding says the place, what was found and what to do about it; its words are those of [`findings`].
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The request contradicts itself or lacks something.
    Usage(Box<Finding>),
    /// A file cannot be read.
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file cannot be written.
    Output {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file holds something that is no recording. The place is the file, its line and column as far as they are known.
    Input(Box<Finding>),
    /// A file holds several recordings, of which one has to be chosen.
    Parts {
        /// Finding at the line where the second recording begins.
        finding: Box<Finding>,
        /// Number of recordings.
        count: usize,
    },
    /// The recording does not determine the parameters.
    NotEnough(Box<Finding>),
    /// The fit did not reach a minimum.
    NotConverged(Box<Finding>),
    /// A watch ended the work ([`crate::watch`]).
    Cancelled,
    /// The solver refused the problem.
    Solver(solver::Error),
}

impl Error {
    /// A request that contradicts itself or lacks something.
    pub fn usage(finding: impl Into<Box<Finding>>) -> Self {
        Self::Usage(finding.into())
    }

    /// A file that holds something that is no recording.
    pub fn input(finding: impl Into<Box<Finding>>) -> Self {
        Self::Input(finding.into())
    }

    /// A recording that does not determine the parameters.
    pub fn not_enough(finding: impl Into<Box<Finding>>) -> Self {
        Self::NotEnough(finding.into())
    }

    /// A fit that did not reach a minimum.
    pub fn not_converged(finding: impl Into<Box<Finding>>) -> Self {
        Self::NotConverged(finding.into())
    }

    /// The finding that ended the work.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Usage(own)
            | Self::Input(own)
            | Self::NotEnough(own)
            | Self::NotConverged(own) => (**own).clone(),
            Self::Parts { finding, .. } => (**finding).clone(),
            Self::Io { path, source } => of_system(Kind::UNREADABLE, path, source),
            Self::Output { path, source } => of_system(Kind::UNWRITABLE, path, source),
            Self::Cancelled => Finding::of(Kind::CANCELLED),
            Self::Solver(refusal) => {
                Finding::of(Kind::SOLVER_REFUSED).detail("reason", refusal.to_string())
            }
        }
    }

    /// The words of the finding, with options as `front` calls them.
    pub fn text(&self, front: Front) -> String {
        self.finding().text(front)
    }
}

fn of_system(kind: Kind, path: &Path, source: &std::io::Error) -> Finding {
    Finding::of_system(kind, source).in_file(shown_path(path))
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text(Front::Plain))
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } | Self::Output { source, .. } => Some(source),
            Self::Solver(refusal) => Some(refusal),
            _ => None,
        }
    }
}

impl From<solver::Error> for Error {
    fn from(refusal: solver::Error) -> Self {
        Self::Solver(refusal)
    }
}
