//! From hand-held recordings to calibrations.
//!
//! ```text
//! Recording ──► intervals ──► residuals + model + mask ──► methods ──► Calibration
//!     ▲         rests, turns                                fits        cal.json, apply
//! simulate
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod averages;
pub mod calibrate;
pub mod calibration;
pub mod covariates;
pub mod discover;
pub mod document;
pub mod effect_file;
mod error;
mod evaluate;
pub mod gravity;
pub mod intervals;
pub mod kernel;
pub mod limits;
pub mod message;
pub mod methods;
pub mod noise;
mod order_statistic;
pub mod prior;
pub mod readings;
pub mod reckon;
pub mod recording;
pub mod residuals;
mod shown;
pub mod simulate;
mod text_file;
mod toml_place;
pub mod truth;
pub mod watch;

pub use calibration::Calibration;
pub use error::Error;
pub use evaluate::{Evaluation, FieldMisfit, Misfit, Misfits, evaluate, misfits};
pub use recording::Recording;
pub use text_file::read_text;
pub use toml_place::explain_toml;
