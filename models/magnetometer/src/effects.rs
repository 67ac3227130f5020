//! The effects a magnetometer can have. A new one is a file here, its `mod` line and its registry line.

use sensor::AnyEffect;

mod mag_g_sensitivity;
mod mag_scale_temperature;
mod mag_temperature;

pub use mag_g_sensitivity::MagGSensitivity;
pub use mag_scale_temperature::MagScaleTemperature;
pub use mag_temperature::MagTemperature;

/// The registry: feeds the command line, the documentation and the registry tests.
pub static EFFECTS: &[&dyn AnyEffect] = &[&MagTemperature, &MagScaleTemperature, &MagGSensitivity];
