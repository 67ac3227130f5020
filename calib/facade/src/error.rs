//! Errors of the library: kind, message, place and advice.

use findings::{Finding, Front};

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
    /// Returns the name of the kind, as in the output of `--json`.
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

/// Error in a recording, a file or a request.
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
/// assert_eq!(error.finding.kind.name(), "array_not_finite");
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
#[non_exhaustive]
pub struct Error {
    /// Kind of the error.
    pub kind: ErrorKind,
    /// Message in words: the value found and the value expected.
    pub message: String,
    /// The file, where it is of one.
    pub file: Option<String>,
    /// Line of the file or row of the arrays, from 1.
    pub line: Option<u64>,
    /// Byte in that line of a file, or column of the arrays (`t, ax, ay, az, gx, gy, gz, temperature`), from 1.
    pub column: Option<u64>,
    /// Advice on how to proceed, where the message gives one.
    pub next: Option<String>,
    /// The same as data: kind, place, numbers, remedies.
    pub finding: Box<Finding>,
}

impl Error {
    /// Builds the error from a finding: its message, its place and its advice, with options named as in this library.
    pub(crate) fn of(kind: ErrorKind, finding: Finding) -> Self {
        let place = &finding.place;
        Self {
            kind,
            message: finding.text(Front::Rust),
            file: place.file.clone(),
            line: place.line,
            column: place.column,
            next: finding.advice(Front::Rust),
            finding: finding.into(),
        }
    }

    pub(crate) fn usage(finding: Finding) -> Self {
        Self::of(ErrorKind::Usage, finding)
    }

    /// The same about arrays: what stands for a file's name is none.
    pub(crate) fn of_arrays(error: &calib::Error) -> Self {
        let mut finding = error.finding();
        finding.place.file = None;
        Self::of(kind_of(error), finding)
    }
}

fn kind_of(error: &calib::Error) -> ErrorKind {
    use calib::Error as E;
    match error {
        E::Usage(_) | E::Parts { .. } => ErrorKind::Usage,
        E::NotEnough(_) => ErrorKind::NotEnoughInformation,
        E::NotConverged(_) | E::Solver(_) => ErrorKind::NotConverged,
        E::Output { .. } => ErrorKind::Output,
        E::Cancelled => ErrorKind::Cancelled,
        _ => ErrorKind::Input,
    }
}

impl From<calib::Error> for Error {
    fn from(error: calib::Error) -> Self {
        Self::of(kind_of(&error), error.finding())
    }
}

impl From<serde_json::Error> for Error {
    fn from(error: serde_json::Error) -> Self {
        Self::of(ErrorKind::Bug, error.to_string().into())
    }
}

impl From<output::Error> for Error {
    fn from(error: output::Error) -> Self {
        Self::of(ErrorKind::Output, error.finding())
    }
}
