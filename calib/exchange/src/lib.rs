//! A calibration in another tool's form, and back: `f = T (A − b)`.
//!
//! ```text
//! cal.json ──► Source ──► Target ──► files, and what of the calibration they do not hold (Loss)
//! imu_tk, Kalibr ──► import ──► Calibration
//! ```
//! A target is one file in `targets/` and one line in [`TARGETS`]. It says by its `keeps` what its tool makes of a
//! reading; what is lost, and how much that is for this device, follows from that.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod error;
pub mod import;
mod kept;
mod loss;
mod source;
mod target;
mod targets;

pub use error::Error;
pub use kept::Kept;
pub use loss::Loss;
pub use source::Source;
pub use target::{Export, Form, Settings, Target, Written, export};
pub use targets::{TARGETS, by_name};
