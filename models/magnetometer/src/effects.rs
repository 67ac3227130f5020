//! The effects a magnetometer can have. A new one is a file here and two lines: its `pub mod` and its place in [`EFFECTS`].

use sensor::effects::{ScaleTemperature, Temperature};
use sensor::{AnyEffect, On, Param, Sensor, axes};

pub mod mag_g_sensitivity;

/// The registry: feeds the command line, the documentation and the registry tests.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &on(Temperature, "mag_temperature", axes("uT/K"), 0.05),
    &on(ScaleTemperature, "mag_scale_temperature", axes("1/K"), 1e-3),
    &mag_g_sensitivity::MagGSensitivity,
];

const fn on<E, const N: usize>(
    effect: E,
    name: &'static str,
    params: [Param; N],
    typical: f64,
) -> On<E, N> {
    On {
        effect,
        sensor: Sensor::Magnetometer,
        name,
        params,
        typical,
        companion: None,
    }
}
