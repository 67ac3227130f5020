//! Where samples come from.

use std::path::{Path, PathBuf};
use std::time::Duration;

use calib::recording::{ReadOptions, Stream};
use serde::Serialize;

use crate::error::Error;
use crate::lines::Lines;
use crate::phyphox::Phyphox;

/// Something that delivers samples while it is asked.
pub trait Source {
    /// What came since the last call. Everything in it is on disk when it returns.
    ///
    /// `now` is the time since the session began by the caller's clock, which may be a simulated one. It waits no longer than a
    /// request does; [`Batch::pause`] says when to ask again.
    ///
    /// # Errors
    /// [`Error::Lost`] where it has not answered for [`Opening::patience`], [`Error::File`] where the recording cannot be written,
    /// [`Error::Unreadable`] where text ended without having been understood.
    fn poll(&mut self, now: Duration) -> Result<Batch, Error>;

    /// Ends the session; the best recording of it that there is.
    ///
    /// # Errors
    /// [`Error::File`] where it cannot be written.
    fn finish(&mut self) -> Result<Finished, Error>;
}

/// What came in one poll.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Specific force, m/s² (or raw counts), stamps later than all before.
    pub accelerometer: Stream,
    /// Angular rate, rad/s (or raw counts), stamps later than all before.
    pub gyroscope: Stream,
    /// What happened.
    pub events: Vec<Event>,
    /// How long to wait before the next poll, beyond the usual.
    pub pause: Option<Duration>,
}

/// What happened to a source.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "event")]
#[non_exhaustive]
pub enum Event {
    /// The source is there.
    Connected {
        /// What it calls itself.
        name: String,
    },
    /// It measures no more.
    Paused,
    /// It measures again, after so many seconds.
    Resumed {
        /// Length of the pause, s; stamps after it are moved on by that.
        seconds: f64,
    },
    /// It did not answer; the attempt is repeated.
    Reconnecting {
        /// Attempts in a row without an answer.
        attempts: u32,
        /// What the last one met.
        cause: String,
    },
    /// It answers again.
    Reconnected,
    /// Its data were cleared and its clock begins anew; what came before is kept in a file of its own.
    Restarted,
    /// Text comes that is not understood yet.
    NotUnderstood {
        /// Why.
        reason: String,
    },
    /// Nothing comes any more.
    Ended,
}

/// What a session leaves.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The recording to calibrate.
    pub recording: PathBuf,
    /// Why it is not the source's own full-precision file, where it could be.
    pub fallback: Option<String>,
}

/// How to open a source.
#[derive(Clone, Debug)]
pub struct Opening {
    /// Folder in which the recording is written; it exists.
    pub folder: PathBuf,
    /// How lines of text are read.
    pub read: ReadOptions,
    /// Speed of a serial port, bits per second.
    pub baud: u32,
    /// How long a phone may not answer before it is lost, by the clock of [`Source::poll`].
    pub patience: Duration,
}

/// Opens what `name` says: the address of a phone (`http://HOST:PORT`, `HOST:PORT`), `-`, a serial port or a file that
/// grows.
///
/// # Errors
/// A name that is neither; a phone that does not answer or lacks a sensor; a file that cannot be opened.
pub fn open(name: &str, how: &Opening) -> Result<Box<dyn Source>, Error> {
    let path = Path::new(name);
    if name == "-" || path.exists() {
        return Ok(Box::new(Lines::open(path, how)?));
    }
    match address(name) {
        Some(address) => Ok(Box::new(Phyphox::connect(&address, how)?)),
        None => Err(Error::NoSource(name.to_owned())),
    }
}

/// `http://host:port` of what may be an address.
fn address(name: &str) -> Option<String> {
    let bare = name.strip_prefix("http://").unwrap_or(name);
    let bare = bare.trim_end_matches('/');
    let (host, port) = bare.rsplit_once(':').unwrap_or((bare, "80"));
    let is_host = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-');
    let is_port = port.parse::<u16>().is_ok_and(|port| port > 0);
    let marked = name.starts_with("http://")
        || bare.contains(':')
        || bare.parse::<std::net::Ipv4Addr>().is_ok();
    let host_fits = !host.is_empty() && host.chars().all(is_host);
    (marked && is_port && host_fits).then(|| format!("http://{host}:{port}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_told_from_a_path() {
        assert_eq!(
            address("192.168.0.12:8080").as_deref(),
            Some("http://192.168.0.12:8080")
        );
        assert_eq!(
            address("http://phone.local:8080/").as_deref(),
            Some("http://phone.local:8080")
        );
        assert_eq!(address("10.0.0.7").as_deref(), Some("http://10.0.0.7:80"));
        for path in [
            "log.txt",
            "/dev/ttyUSB9",
            "a b:80",
            "https://phone:80",
            "phone:0",
        ] {
            assert_eq!(address(path), None, "{path}");
        }
    }
}
