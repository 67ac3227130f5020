//! The effects a magnetometer can have. A new one is a file here and two lines: its `pub mod` and its place in [`EFFECTS`].

use sensor::AnyEffect;

pub mod mag_g_sensitivity;
pub mod mag_scale_temperature;
pub mod mag_temperature;

/// The registry: feeds the command line, the documentation and the registry tests.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &mag_temperature::MagTemperature,
    &mag_scale_temperature::MagScaleTemperature,
    &mag_g_sensitivity::MagGSensitivity,
];
