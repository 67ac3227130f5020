//! From hand-held recordings to calibrations: the rooms of the library under one name.
//!
//! ```text
//! recording ──► estimate ──► discover
//!     ▲            ▲
//! simulate      effects
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod document;
pub mod reckon;

pub use discover;
pub use effects::{self, covariates, effect_file};
pub use estimate::{
    Calibration, Evaluation, FieldMisfit, Misfit, Misfits, calibrate, calibration, evaluate,
    gravity, kernel, limits, methods, misfits, prior, residuals, truth,
};
pub use noise;
pub use recording::{self, Error, Recording, explain_toml, intervals, read_text, readings, watch};
pub use simulate;
