//! Sources of samples.

mod error;
mod lines;
mod open;
mod phyphox;
mod recorder;
mod serial;

use std::path::PathBuf;
use std::time::Duration;

use calib::recording::ReadOptions;

use crate::batch::Batch;

pub use error::{Error, Limit};
pub use lines::Lines;
pub use open::open;
pub use phyphox::Phyphox;
pub use recorder::Recorder;

/// Files that a session writes into its folder.
pub const FILES: [&str; 5] = [
    "lines.txt",
    "phyphox.zip",
    "received",
    "received/acc.csv",
    "received/gyro.csv",
];

/// Something that delivers samples while it is asked.
pub trait Source {
    /// Returns the samples since the last call. All of them are on disk when it returns.
    ///
    /// `now` is the time since the session began by the caller's clock, which may be a simulated one. The call waits no
    /// longer than one request; [`Batch::pause`] gives the time until the next call.
    ///
    /// # Errors
    /// [`Error::Lost`] if the source has not answered for [`Opening::patience`], [`Error::File`] if the recording
    /// cannot be written, [`Error::Unreadable`] if the text ended and could not be read.
    fn poll(&mut self, now: Duration) -> Result<Batch, Error>;

    /// Ends the session; the best recording of it that there is.
    ///
    /// # Errors
    /// [`Error::File`] where it cannot be written.
    fn finish(&mut self) -> Result<Finished, Error>;
}

/// Result of a session.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The recording to calibrate.
    pub recording: PathBuf,
    /// Why it is not the source's own full-precision file, where it could be.
    pub fallback: Option<String>,
}

/// Timeouts for the answers of a phone.
#[derive(Clone, Copy, Debug)]
pub struct Waits {
    /// For an answer.
    pub answer: Duration,
    /// For the exported file, all attempts together: it takes the phone a while to write.
    pub export: Duration,
}

impl Default for Waits {
    fn default() -> Self {
        Self {
            answer: Duration::from_secs(5),
            export: Duration::from_secs(120),
        }
    }
}

/// Options for opening a source.
#[derive(Clone, Debug)]
pub struct Opening {
    /// Folder in which the recording is written; it exists.
    pub folder: PathBuf,
    /// Options of the reader of text lines.
    pub read: ReadOptions,
    /// Speed of a serial port, bits per second.
    pub baud: u32,
    /// Longest time without an answer before a phone is lost, by the clock of [`Source::poll`].
    pub patience: Duration,
    /// Timeouts for the answers of a phone.
    pub waits: Waits,
}
