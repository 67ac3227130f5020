//! The effects a gyroscope can have. A new one is a file here and two lines: its `pub mod` and its place in
//! [`EFFECTS`]; of one that other sensors have alike (`sensor::effects`) a line is enough.

use sensor::effects::{
    Asymmetry, Cubic, Drift, MisalignmentTemperature, Quadratic, Relaxation, ScaleDrift,
    ScaleTemperature, Step, Temperature, TemperatureQuadratic, TemperatureRate, ThermalHysteresis,
    Warmup,
};
use sensor::{AnyEffect, Sensor, axes_and};

pub mod earth_rate;
pub mod gyro_delay;
pub mod gyro_g2_sensitivity;
pub mod gyro_g_sensitivity;
pub mod gyro_low_pass;
pub mod gyro_room_field;
pub mod gyro_vibration_rectification;

/// The rotation of the earth, for those who know a latitude.
pub static EARTH_ROTATION: &dyn AnyEffect = &earth_rate::EarthRate;

/// The sensitivity to specific force, a matrix that formats of other programs hold too: `ω = T (W − b) − G f`.
pub static FORCE_SENSITIVITY: &dyn AnyEffect = &gyro_g_sensitivity::GyroGSensitivity;

const SENSOR: Sensor = Sensor::Gyroscope;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &gyro_g_sensitivity::GyroGSensitivity,
    &gyro_g2_sensitivity::GyroG2Sensitivity,
    &SENSOR.has(Drift, "gyro_drift", "rad/s^2", 5e-7),
    &SENSOR.has_with(Warmup, "gyro_warmup", axes_and("rad/s", Warmup::TAU), 5e-4),
    &SENSOR.has(Temperature, "gyro_temperature", "rad/s/K", 5e-5),
    &SENSOR.has(ScaleTemperature, "gyro_scale_temperature", "1/K", 2e-4),
    &SENSOR.has_with(Step, "gyro_step", axes_and("rad/s", Step::T0), 2e-4),
    &SENSOR.has(Quadratic, "gyro_quadratic", "1/(rad/s)", 4e-4),
    &SENSOR.has(Cubic, "gyro_cubic", "1/(rad/s)^2", 2e-4),
    &SENSOR.has(Asymmetry, "gyro_asymmetry", "", 5e-4),
    &gyro_delay::GyroDelay,
    &gyro_low_pass::GyroLowPass,
    &SENSOR.has_with(
        MisalignmentTemperature,
        "gyro_misalignment_temperature",
        MisalignmentTemperature::PARAMS,
        1e-4,
    ),
    &SENSOR.has_with(
        Relaxation,
        "gyro_relaxation",
        axes_and("rad/s", Relaxation::TAU),
        2e-4,
    ),
    &gyro_room_field::GyroRoomField,
    &SENSOR
        .has(
            TemperatureQuadratic,
            "gyro_temperature_quadratic",
            "rad/s/K^2",
            5e-6,
        )
        .with_companion("gyro_temperature"),
    &SENSOR.has(TemperatureRate, "gyro_temperature_rate", "rad/K", 5e-3),
    &SENSOR.has(ThermalHysteresis, "gyro_thermal_hysteresis", "rad/s", 1e-4),
    &gyro_vibration_rectification::GyroVibrationRectification,
    &SENSOR.has(ScaleDrift, "gyro_scale_drift", "1/s", 3e-6),
    &earth_rate::EarthRate,
];
