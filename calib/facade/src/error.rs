//! What is wrong, where, and what to do.

use calib::message::{Place, advice};
use findings::Front;

use crate::words;

/// The kinds of what can be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The request contradicts itself or lacks something.
    Usage,
    /// A file or an array is unreadable or no recording.
    Input,
    /// The recordings do not determine what was asked for.
    NotEnoughInformation,
    /// A fit did not reach a minimum.
    NotConverged,
    /// A file could not be written.
    Output,
    /// A [`Watch`](crate::Watch) ended the work.
    Cancelled,
    /// A bug of ours.
    Bug,
}

impl ErrorKind {
    /// As the command's `--json` writes it.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(stillpoint::ErrorKind::Input.name(), "input");
    /// ```
    pub fn name(self) -> &'static str {
        match self {
            Self::Usage => "usage",
            Self::Input => "input",
            Self::NotEnoughInformation => "not_enough_information",
            Self::NotConverged => "not_converged",
            Self::Output => "output",
            Self::Cancelled => "cancelled",
            Self::Bug => "bug",
        }
    }
}

/// What is wrong with a recording, a file or a request.
///
/// # Examples
/// ```
/// use stillpoint::{ErrorKind, Recording};
///
/// let accel = [[0.0, 0.0, 9.8], [0.0, f64::NAN, 9.8], [0.0, 0.0, 9.8]];
/// let error = Recording::from_arrays(&[0.0, 0.1, 0.2], &accel, &[], None).unwrap_err();
/// assert_eq!(error.kind, ErrorKind::Input);
/// assert_eq!((error.line, error.column), (Some(2), Some(3)));
/// assert_eq!(error.next.as_deref(), Some("leave such rows out"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
#[non_exhaustive]
pub struct Error {
    /// What kind of thing is wrong.
    pub kind: ErrorKind,
    /// What was found and what is expected, in words.
    pub message: String,
    /// The file, where it is of one.
    pub file: Option<String>,
    /// Line of the file or row of the arrays, from 1.
    pub line: Option<u64>,
    /// Byte in that line of a file, or column of the arrays (`t, ax, ay, az, gx, gy, gz, temperature`), from 1.
    pub column: Option<u64>,
    /// What to do about it, where the message says so.
    pub next: Option<String>,
}

impl Error {
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        let message = message.into();
        let next = advice(&message).map(str::to_owned);
        Self {
            kind,
            message,
            file: None,
            line: None,
            column: None,
            next,
        }
    }

    pub(crate) fn usage(message: impl Into<String>) -> Self {
        Self::new(ErrorKind::Usage, message)
    }

    /// The same about arrays: what stands for a file's name is none.
    pub(crate) fn of_arrays(error: &calib::Error) -> Self {
        let mut own = Self::from_calib(error);
        let raw = error.text(Front::Rust);
        if let Some(place) = Place::of(&raw) {
            let place_words = match place.column {
                Some(column) => format!("row {}, column {column}", place.line),
                None => format!("row {}", place.line),
            };
            own.message = format!("{place_words}: {}", words::of_the_library(place.what));
        }
        own.file = None;
        own
    }

    fn from_calib(error: &calib::Error) -> Self {
        use calib::Error as E;
        let kind = match error {
            E::Usage(_) | E::Parts { .. } => ErrorKind::Usage,
            E::NotEnough(_) => ErrorKind::NotEnoughInformation,
            E::NotConverged(_) | E::Solver(_) => ErrorKind::NotConverged,
            E::Output { .. } => ErrorKind::Output,
            E::Cancelled => ErrorKind::Cancelled,
            _ => ErrorKind::Input,
        };
        let finding = error.finding();
        let raw = finding.text(Front::Rust);
        let place = Place::of(&raw);
        let file = match error {
            E::Io { path, .. } | E::Output { path, .. } => Some(path.display().to_string()),
            _ => place.map(|place| place.file.to_owned()),
        };
        Self {
            file,
            line: place.map(|place| place.line),
            column: place.and_then(|place| place.column),
            next: finding
                .advice(Front::Rust)
                .or_else(|| advice(&raw).map(words::of_the_library)),
            ..Self::new(kind, words::of_the_library(&raw))
        }
    }
}

impl From<calib::Error> for Error {
    fn from(error: calib::Error) -> Self {
        Self::from_calib(&error)
    }
}

impl From<serde_json::Error> for Error {
    fn from(error: serde_json::Error) -> Self {
        Self::new(ErrorKind::Bug, error.to_string())
    }
}
