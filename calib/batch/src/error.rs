//! Errors of a batch as a whole. Errors of a single device are in its record.

use std::fmt;
use std::path::{Path, PathBuf};

use calib::recording::shown::shown_path;
use findings::{Finding, Kind, Remedy};

/// A batch that cannot be run or merged. The words are those of [`Error::finding`].
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// A manifest that says what is none, with its file and line.
    Manifest(Box<Finding>),
    /// An input that cannot be taken.
    Input(Box<Finding>),
    /// A file or folder that cannot be read.
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file or folder that cannot be written.
    Output {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Parts that do not make a whole.
    Parts(Vec<Finding>),
    /// A part of the work that is misspelt.
    Shard(String),
    /// Too few devices for what was asked.
    TooFew {
        /// Devices that have them.
        found: usize,
        /// Parameters.
        parameters: usize,
        /// Devices that would do.
        needed: usize,
    },
}

impl Error {
    /// The finding that ended the run.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Manifest(found) | Self::Input(found) => (**found).clone(),
            Self::Io { path, source } => {
                Finding::of_system(Kind::UNREADABLE, source).in_file(shown_path(path))
            }
            Self::Output { path, source } => Finding::of_system(Kind::UNWRITABLE, source)
                .in_file(shown_path(path))
                .remedy(Remedy::for_writing(source.kind())),
            Self::Parts(faults) if faults.is_empty() => Finding::of(Kind::NO_PARTS),
            Self::Parts(faults) => faults
                .iter()
                .cloned()
                .fold(Finding::of(Kind::PARTS_INCOMPLETE), Finding::because),
            Self::Shard(text) => Finding::of(Kind::SHARD_WRONG).detail("text", text),
            Self::TooFew {
                found,
                parameters,
                needed,
            } => Finding::of(Kind::DEVICES_TOO_FEW)
                .count("found", *found)
                .count("parameters", *parameters)
                .count("needed", *needed),
        }
    }

    /// A file that cannot be read.
    pub(crate) fn at(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        |source| Self::Io {
            path: path.to_owned(),
            source,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } | Self::Output { source, .. } => Some(source),
            _ => None,
        }
    }
}

impl From<output::Error> for Error {
    fn from(error: output::Error) -> Self {
        Self::Output {
            path: error.path.clone(),
            source: error.into(),
        }
    }
}
