//! Errors of reading a file.

use std::{fmt, io};

use findings::{Finding, Kind};

/// Why a file is not read, or not read further. The finding has the byte, or the line and column, as far as they are known;
/// its words are those of [`findings`].
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The system's reason.
    Io(io::Error),
    /// The content contradicts its format, at the byte of the finding's place.
    Damaged(Box<Finding>),
    /// The content is of the format and of no use, or there is too much of it.
    Refused(Box<Finding>),
}

impl Error {
    /// Damage at byte `at`.
    pub fn at(at: u64, found: impl Into<Box<Finding>>) -> Self {
        let mut found = found.into();
        found.place.byte = Some(at);
        Self::Damaged(found)
    }

    /// A refusal.
    pub fn refused(found: impl Into<Box<Finding>>) -> Self {
        Self::Refused(found.into())
    }

    /// The finding that ended the reading.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Io(error) => {
                Finding::of(Kind::READING_STOPPED).detail("reason", error.to_string())
            }
            Self::Damaged(found) | Self::Refused(found) => (**found).clone(),
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
            Self::Io(error) => Some(error),
            Self::Damaged(_) | Self::Refused(_) => None,
        }
    }
}

impl From<io::Error> for Error {
    /// The system's reason, or what one of our own readers said through [`io::Read`].
    fn from(error: io::Error) -> Self {
        error.downcast::<Self>().unwrap_or_else(Self::Io)
    }
}

impl From<Error> for io::Error {
    /// For [`io::Read`]; [`Error::from`] gives it back.
    fn from(error: Error) -> Self {
        match error {
            Error::Io(error) => error,
            own => Self::other(own),
        }
    }
}

/// A number of bytes, rows or the like that may be beyond those of an array.
pub(crate) fn counted(found: Finding, name: &'static str, count: u64) -> Finding {
    found.number(name, count as f64, "count")
}

/// A part of a file that ends too early.
pub(crate) fn cut(part: impl Into<String>, whole: &str) -> Finding {
    let found = Finding::of(Kind::PART_CUT).detail("part", part);
    found.detail("whole", whole)
}

/// A part of a file that is damaged.
pub(crate) fn damaged(part: &str) -> Finding {
    Finding::of(Kind::PART_DAMAGED).detail("part", part)
}

/// A part of a file that is longer or shorter than something says of it.
pub(crate) fn contradicted(part: &str, than: &str, stated: &str) -> Finding {
    let found = Finding::of(Kind::LENGTH_CONTRADICTED).detail("part", part);
    found.detail("than", than).detail("stated", stated)
}

/// A file that a parser of another project refuses.
#[cfg(any(feature = "parquet", feature = "hdf5", feature = "xlsx"))]
pub(crate) fn unreadable(format: impl Into<String>, error: &dyn fmt::Display) -> Error {
    let found = Finding::of(Kind::FORMAT_UNREADABLE).detail("format", format);
    Error::refused(found.detail("reason", error.to_string()))
}

/// Text that is no JSON from a place on.
pub(crate) fn no_json(error: &serde_json::Error) -> Error {
    let words = error.to_string();
    let reason = words
        .rsplit_once(" at line ")
        .map_or(&*words, |(reason, _)| reason);
    let found = Finding::of(Kind::JSON_DAMAGED)
        .at_line(error.line() as u64)
        .at_column(error.column() as u64);
    Error::refused(found.detail("reason", reason))
}
