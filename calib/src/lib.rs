//! From hand-held recordings to calibrations.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod calibrate;
pub mod calibration;
mod error;
pub mod intervals;
pub mod methods;
pub mod noise;
pub mod reckon;
pub mod recording;
pub mod residuals;

pub use calibration::Calibration;
pub use error::Error;
pub use recording::Recording;
