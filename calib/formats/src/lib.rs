//! Recordings as other programs write them: archives, logs of flight controllers, bags of robots, MATLAB files.
//!
//! ```text
//! folder, zip ── Container ── entries ─┐
//!                                      ├─ Format::begins(first bytes)
//! file ────────────────────────────────┘        │
//!                                        Format::read ── Recorder ── streams: int64 ns, three values in SI units
//! ```
//! A format is one file and one value. It is recognised by content, reads forward, names byte and record where
//! something is wrong, and holds no more in memory than it has read. What the streams mean to a calibration is not
//! known here.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod ardupilot;
mod blackbox;
mod bytes;
pub mod container;
#[cfg(test)]
mod damage;
mod error;
mod format;
mod limits;
pub mod make;
mod mat;
mod registry;
mod ros;
mod sensor_logger_json;
mod shown;
mod store;
mod stream;
mod tables;
mod ulog;
mod unpack;

pub use container::{Container, Entry, read_folder};
pub use error::Error;
pub use format::{Format, ReadSeek};
pub use limits::Limits;
pub use registry::{FORMATS, recognise};
pub use stream::{Content, Correction, Quantity, Stream, Wanted};
pub use tables::{TABULAR, Tabular, catches_panics, write_parquet};
