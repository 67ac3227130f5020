//! What can end a session before it is complete.

use std::path::PathBuf;

/// Why samples do not come or cannot be kept.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The source is no address, path or `-`.
    #[error(
        "{0}: neither the address of a phone (http://192.168.0.12:8080) nor a file that exists, nor `-`"
    )]
    NoSource(String),
    /// Nothing answers, or not for too long.
    #[error("{address}: no answer{for_how_long} ({cause})", for_how_long = lasting(*seconds))]
    Lost {
        /// The address asked.
        address: String,
        /// For how long, s; 0 where it never answered.
        seconds: f64,
        /// What the last one met.
        cause: String,
    },
    /// Its measurement begins again and again.
    #[error("{address}: the measurement began anew {times} times")]
    Restless {
        /// The address asked.
        address: String,
        /// How often.
        times: usize,
    },
    /// More text comes than a session has, or text without lines.
    #[error("{name}: {what}")]
    TooMuch {
        /// The source.
        name: String,
        /// What there is too much of.
        what: &'static str,
    },
    /// Something answers that does not speak the protocol.
    #[error("{address}: not phyphox's remote access ({found})")]
    NotPhyphox {
        /// The address asked.
        address: String,
        /// What was found instead.
        found: String,
    },
    /// The experiment that is open on the phone lacks a sensor.
    #[error(
        "{address}: the experiment `{experiment}` has no {sensor} with x, y, z and time (found: {found})"
    )]
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
    #[error("{path}: {cause}", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        cause: std::io::Error,
    },
    /// Text arrives that is no recording.
    #[error(transparent)]
    Unreadable(#[from] calib::Error),
}

impl Error {
    /// Whether what had come before is a session all the same.
    pub fn ends_a_session(&self) -> bool {
        matches!(
            self,
            Self::Lost { .. } | Self::Restless { .. } | Self::TooMuch { .. }
        )
    }

    /// Names the file that an operation failed on.
    pub(crate) fn at(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        |cause| Self::File {
            path: path.to_owned(),
            cause,
        }
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

/// ` for 180 s`.
fn lasting(seconds: f64) -> String {
    match seconds {
        0.0 => String::new(),
        seconds => format!(" for {seconds:.0} s"),
    }
}
