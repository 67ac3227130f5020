//! The magnetometer, by the attitudes that a calibrated accelerometer and gyroscope give.
//!
//! At rest a magnetometer reads `M = T⁻¹ (m + effects) + b` of the field `m = Rᵀ h` that lies still in the room. The
//! accelerometer knows the attitude `R` but for the heading; through turns the gyroscope carries the heading on. All of it
//! is one graph:
//!
//! ```text
//! field of a recording (inclination, strength) ─┐
//! mag (T, b, effects) ──────────────────────────┼─► reading of a placement
//! heading of a placement ───────────────────────┤
//! errors of the other sensors ──────────────────┴─► turn ◄── headings and rate offsets on both sides
//! ```
//! The errors of accelerometer and gyroscope enter with the covariance of their own calibration: they widen the errors of
//! the magnetometer, and what the magnetometer says of headings comes back to the gyroscope.
//!
//! `start` finds the neighbourhood without a guess; `unevenness` is how much the field differs from place to place, by
//! restricted likelihood; `disturbed` finds places that differ from all others; [`fit_magnetometer`] does all of it.

mod disturbed;
mod factors;
mod fit;
mod fitted;
mod linear;
mod placement;
mod problem;
mod result;
mod start;
mod unevenness;

pub use fit::{MagneticRequest, chi2_at, fit_at, fit_magnetometer};
pub use fitted::{Field, Fitted, MagneticFit, OwnBias};
pub use placement::{HeadingChange, Placement, Rest};
