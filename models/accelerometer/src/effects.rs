//! The effects an accelerometer can have. A new one is a file here and two lines: its `pub mod` and its place in
//! [`EFFECTS`]; of one that other sensors have alike (`sensor::effects`) a line is enough.

use sensor::effects::{
    Asymmetry, Cubic, Drift, MisalignmentTemperature, Quadratic, Relaxation, ScaleDrift,
    ScaleTemperature, Step, Temperature, TemperatureQuadratic, TemperatureRate, ThermalHysteresis,
    Warmup,
};
use sensor::{AnyEffect, Sensor, axes_and};

pub mod accel_cross_axis;
pub mod accel_hysteresis;
pub mod accel_periodic;
pub mod accel_room_field;
pub mod accel_vibration_rectification;
pub mod time_offset;

const SENSOR: Sensor = Sensor::Accelerometer;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &SENSOR.has(Quadratic, "accel_quadratic", "1/(m/s^2)", 1e-4),
    &SENSOR.has(Cubic, "accel_cubic", "1/(m/s^2)^2", 1e-5),
    &SENSOR.has(Asymmetry, "accel_asymmetry", "", 1e-3),
    &accel_cross_axis::AccelCrossAxis,
    &SENSOR.has(Drift, "accel_drift", "m/s^3", 1.5e-5),
    &SENSOR.has_with(Warmup, "accel_warmup", axes_and("m/s^2", Warmup::TAU), 1e-2),
    &SENSOR.has(Temperature, "accel_temperature", "m/s^2/K", 2e-3),
    &SENSOR
        .has(
            TemperatureQuadratic,
            "accel_temperature_quadratic",
            "m/s^2/K^2",
            2e-4,
        )
        .with_companion("accel_temperature"),
    &SENSOR.has(ScaleTemperature, "accel_scale_temperature", "1/K", 2e-4),
    &SENSOR.has_with(Step, "accel_step", axes_and("m/s^2", Step::T0), 5e-3),
    &accel_hysteresis::AccelHysteresis,
    &accel_vibration_rectification::AccelVibrationRectification,
    &SENSOR.has_with(
        MisalignmentTemperature,
        "accel_misalignment_temperature",
        MisalignmentTemperature::PARAMS,
        1e-4,
    ),
    &accel_periodic::AccelPeriodic,
    &SENSOR.has_with(
        Relaxation,
        "accel_relaxation",
        axes_and("m/s^2", Relaxation::TAU),
        5e-3,
    ),
    &accel_room_field::AccelRoomField,
    &SENSOR.has(TemperatureRate, "accel_temperature_rate", "m/s/K", 2e-1),
    &SENSOR.has(ThermalHysteresis, "accel_thermal_hysteresis", "m/s^2", 5e-3),
    &SENSOR.has(ScaleDrift, "accel_scale_drift", "1/s", 3e-6),
    &time_offset::TimeOffset,
];
