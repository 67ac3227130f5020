//! From recordings to calibrations.
//!
//! ```text
//! intervals ──► truth ──► methods ──► calibrate ──► Calibration ──► evaluate
//!               what is   fits        checks,       cal.json,       what it leaves of
//!               known                 warnings      apply           other recordings
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod calibrate;
pub mod calibration;
mod evaluate;
pub mod gravity;
pub mod kernel;
pub mod limits;
pub mod methods;
pub mod prior;
pub mod residuals;
pub mod truth;
mod unreadable;

pub use calibration::Calibration;
pub use evaluate::{Evaluation, FieldMisfit, Misfit, Misfits, evaluate, misfits};
