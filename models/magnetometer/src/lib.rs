//! The magnetometer: `m = T (M − b)` plus effects.
//!
//! `b` is the hard iron: magnets that turn with the device. `T` holds the scale factors, the soft iron (iron that bends the
//! field) and the misalignment against the accelerometer's axes; these three cannot be told apart. All nine elements are
//! observable where the device was held in enough attitudes, but for their common scale: that takes the strength of the
//! field.

pub mod effects;

pub use effects::EFFECTS;
use sensor::{Model, Sensor};

/// The base model of a magnetometer.
///
/// ```
/// assert_eq!(stillpoint_magnetometer::model().parameters().names()[3], "mag.gamma_yz");
/// ```
pub fn model() -> Model {
    Model::base(Sensor::Magnetometer)
}
