//! The effects a gyroscope can have. A new one is a file here and two lines: its `pub mod` and its place in [`EFFECTS`].

use sensor::effects::{
    Asymmetry, Cubic, Drift, MisalignmentTemperature, Quadratic, Relaxation, ScaleDrift,
    ScaleTemperature, Step, Temperature, TemperatureQuadratic, TemperatureRate, ThermalHysteresis,
    Warmup,
};
use sensor::{AnyEffect, On, Param, Sensor, axes};

pub mod earth_rate;
pub mod gyro_delay;
pub mod gyro_g2_sensitivity;
pub mod gyro_g_sensitivity;
pub mod gyro_room_field;
pub mod gyro_vibration_rectification;

/// The rotation of the earth, for those who know a latitude.
pub static EARTH_ROTATION: &dyn AnyEffect = &earth_rate::EarthRate;

/// The sensitivity to specific force, a matrix that formats of other programs hold too: `ω = T (W − b) − G f`.
pub static FORCE_SENSITIVITY: &dyn AnyEffect = &gyro_g_sensitivity::GyroGSensitivity;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &gyro_g_sensitivity::GyroGSensitivity,
    &gyro_g2_sensitivity::GyroG2Sensitivity,
    &on(Drift, "gyro_drift", axes("rad/s^2"), 5e-7),
    &on(Warmup, "gyro_warmup", Warmup::params("rad/s"), 5e-4),
    &on(Temperature, "gyro_temperature", axes("rad/s/K"), 5e-5),
    &on(
        ScaleTemperature,
        "gyro_scale_temperature",
        axes("1/K"),
        2e-4,
    ),
    &on(Step, "gyro_step", Step::params("rad/s"), 2e-4),
    &on(Quadratic, "gyro_quadratic", axes("1/(rad/s)"), 4e-4),
    &on(Cubic, "gyro_cubic", axes("1/(rad/s)^2"), 2e-4),
    &on(Asymmetry, "gyro_asymmetry", axes(""), 5e-4),
    &gyro_delay::GyroDelay,
    &on(
        MisalignmentTemperature,
        "gyro_misalignment_temperature",
        MisalignmentTemperature::PARAMS,
        1e-4,
    ),
    &on(
        Relaxation,
        "gyro_relaxation",
        Relaxation::params("rad/s"),
        2e-4,
    ),
    &gyro_room_field::GyroRoomField,
    &on(
        TemperatureQuadratic,
        "gyro_temperature_quadratic",
        axes("rad/s/K^2"),
        5e-6,
    )
    .with_companion("gyro_temperature"),
    &on(
        TemperatureRate,
        "gyro_temperature_rate",
        axes("rad/K"),
        5e-3,
    ),
    &on(
        ThermalHysteresis,
        "gyro_thermal_hysteresis",
        axes("rad/s"),
        1e-4,
    ),
    &gyro_vibration_rectification::GyroVibrationRectification,
    &on(ScaleDrift, "gyro_scale_drift", axes("1/s"), 3e-6),
    &earth_rate::EarthRate,
];

const fn on<E, const N: usize>(
    effect: E,
    name: &'static str,
    params: [Param; N],
    typical: f64,
) -> On<E, N> {
    On {
        effect,
        sensor: Sensor::Gyroscope,
        name,
        params,
        typical,
        companion: None,
    }
}
