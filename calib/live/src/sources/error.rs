//! Errors that end a session before it is complete.

use std::fmt;
use std::path::PathBuf;

use calib::recording::shown::shown_path;
use findings::{Finding, Kind};

/// Why samples do not come or cannot be kept. The words are those of [`Error::finding`].
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The source is no address, path or `-`.
    NoSource(String),
    /// Nothing answers, or not for too long.
    Lost {
        /// The address asked.
        address: String,
        /// For how long, s; 0 where it never answered.
        seconds: f64,
        /// The reason of the last attempt.
        cause: String,
    },
    /// Its measurement begins again and again.
    Restless {
        /// The address asked.
        address: String,
        /// Number of restarts.
        times: usize,
    },
    /// More comes than a session has, or text without lines.
    TooMuch {
        /// The source.
        name: String,
        /// The limit that is passed.
        limit: Limit,
    },
    /// Something answers that does not speak the protocol.
    NotPhyphox {
        /// The address asked.
        address: String,
        /// The beginning of its answer.
        begin: String,
    },
    /// The experiment that is open on the phone lacks a sensor.
    NoSensor {
        /// The address asked.
        address: String,
        /// The experiment's title.
        experiment: String,
        /// The sensor that is missing.
        sensor: &'static str,
        /// The inputs that it has.
        found: String,
    },
    /// A file cannot be read or written.
    File {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        cause: std::io::Error,
    },
    /// Text arrives that is no recording.
    Unreadable(calib::Error),
}

/// Limits of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Bytes of a line.
    Line(usize),
    /// Bytes of text.
    Text(u64),
    /// Samples of a sensor.
    Samples(usize),
}

impl Error {
    /// Returns true if the samples received before the error still make a session.
    pub fn ends_a_session(&self) -> bool {
        matches!(
            self,
            Self::Lost { .. }
                | Self::Restless { .. }
                | Self::TooMuch { .. }
                | Self::Unreadable(calib::Error::Io { .. })
        )
    }

    /// The finding that ended the session, with its source or file as the place.
    pub fn finding(&self) -> Finding {
        match self {
            Self::NoSource(name) => Finding::of(Kind::SOURCE_UNKNOWN).in_file(name),
            Self::Lost {
                address,
                seconds,
                cause,
            } => {
                let lost = Finding::of(Kind::PHONE_LOST).in_file(address);
                let lost = lost.detail("reason", cause);
                match *seconds > 0.0 {
                    true => lost.number("seconds", *seconds, "s"),
                    false => lost,
                }
            }
            Self::Restless { address, times } => Finding::of(Kind::PHONE_RESTLESS)
                .in_file(address)
                .count("times", *times),
            Self::TooMuch { name, limit } => match *limit {
                Limit::Line(bytes) => Finding::of(Kind::LINE_WITHOUT_END).count("limit", bytes),
                Limit::Text(bytes) => {
                    Finding::of(Kind::TEXT_TOO_LONG).number("limit", bytes as f64, "count")
                }
                Limit::Samples(count) => Finding::of(Kind::SESSION_TOO_LONG).count("limit", count),
            }
            .in_file(name),
            Self::NotPhyphox { address, begin } => Finding::of(Kind::NOT_PHYPHOX)
                .in_file(address)
                .detail("begin", begin),
            Self::NoSensor {
                address,
                experiment,
                sensor,
                found,
            } => Finding::of(Kind::PHONE_WITHOUT_SENSOR)
                .in_file(address)
                .detail("experiment", experiment)
                .detail("missing", *sensor)
                .detail("found", found),
            Self::File { path, cause } => {
                Finding::of_system(Kind::SESSION_FILE, cause).in_file(shown_path(path))
            }
            Self::Unreadable(error) => error.finding(),
        }
    }

    /// Names the file that an operation failed on.
    pub(crate) fn at(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        |cause| Self::File {
            path: path.to_owned(),
            cause,
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
            Self::File { cause, .. } => Some(cause),
            Self::Unreadable(error) => Some(error),
            _ => None,
        }
    }
}

impl From<calib::Error> for Error {
    fn from(error: calib::Error) -> Self {
        Self::Unreadable(error)
    }
}

impl From<output::Error> for Error {
    fn from(error: output::Error) -> Self {
        Self::File {
            path: error.path.clone(),
            cause: error.into(),
        }
    }
}
