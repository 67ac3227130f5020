//! The effects a magnetometer can have. A new one is a file here and two lines: its `pub mod` and its place in
//! [`EFFECTS`]; of one that other sensors have alike (`sensor::effects`) a line is enough.

use sensor::effects::{Cubic, Drift, Quadratic, ScaleTemperature, Temperature};
use sensor::{AnyEffect, Sensor};

pub mod mag_g_sensitivity;

const SENSOR: Sensor = Sensor::Magnetometer;

/// The registry: feeds the command line, the documentation and the registry tests.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &SENSOR.has(Temperature, "mag_temperature", "uT/K", 0.05),
    &SENSOR.has(ScaleTemperature, "mag_scale_temperature", "1/K", 1e-3),
    &mag_g_sensitivity::MagGSensitivity,
    &SENSOR.has(Drift, "mag_drift", "uT/s", 2e-3),
    &SENSOR.has(Quadratic, "mag_quadratic", "1/uT", 1e-4),
    &SENSOR.has(Cubic, "mag_cubic", "1/uT^2", 2e-6),
];
