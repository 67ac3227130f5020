//! From hand-held recordings to calibrations.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod covariates;
mod error;
pub mod recording;
pub mod simulate;

pub use error::Error;
pub use recording::Recording;
