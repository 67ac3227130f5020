//! Recordings of inertial sensors: read from files or arrays, checked, cut into static intervals and turns.
//!
//! ```text
//! file ──► recording ──► readings ──► intervals
//!          SI units,     clipped,     static intervals,
//!          own clocks    stuck, ..    turns
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod averages;
mod did_you_mean;
mod error;
pub mod intervals;
mod order_statistic;
pub mod readings;
mod recording;
pub mod shown;
mod text_file;
pub mod toml_place;
pub mod watch;

pub use did_you_mean::did_you_mean;
pub use error::Error;
pub use recording::*;
pub use text_file::read_text;
pub use toml_place::explain_toml;
