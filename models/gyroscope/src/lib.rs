//! The gyroscope: `ω = T (W − b)` plus effects.
//!
//! Its nine elements of `T` are relative to the accelerometer's frame and all observable, if the
//! recording turns enough.

pub mod effects;

pub use effects::earth_rate::EARTH_RATE;
pub use effects::gyro_g_sensitivity::GyroGSensitivity;
pub use effects::{EARTH_ROTATION, EFFECTS, FORCE_SENSITIVITY};
use sensor::{Model, Sensor};

/// The base model of a gyroscope.
pub fn model() -> Model {
    Model::base(Sensor::Gyroscope)
}
