//! Recordings of inertial sensors: read from files or arrays, checked, cut into static intervals and turns.
//!
//! ```text
//! file ──► recording ──► readings ──► intervals
//!          SI units,     clipped,     static intervals,
//!          own clocks    stuck, ..    turns
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod averages;
mod clock;
mod devices;
mod error;
pub mod formats;
mod header;
pub mod intervals;
mod order_statistic;
pub mod readings;
mod recording;
mod rows;
pub mod shown;
mod source;
mod spelling;
mod static_means;
mod text_file;
pub mod toml_place;
mod units;
pub mod watch;

pub use clock::drift::{ClockDrift, clock_drift};
pub use clock::even::{Bursts, EvenClock, Stamps, bursts, even_clock};
pub use clock::offset::clock_offset;
pub use devices::mixed::in_turn as devices_in_turn;
pub use error::Error;
pub use recording::*;
pub use rows::plain;
pub use shown::{figure, significant};
pub use source::{Input, batches, cut, pipeline};
pub use static_means::read_static_means;
pub use text_file::read_text;
pub use toml_place::explain_toml;
pub use units::decide::are_no_rates_at_rest;
pub use units::field::FieldUnit;
pub use units::{AccelUnit, GyroUnit, TemperatureUnit, TimeUnit};
