//! The effects an accelerometer can have. A new one is a file here and two lines: its `pub mod` and its place in [`EFFECTS`].

use sensor::effects::{
    Asymmetry, Cubic, Drift, MisalignmentTemperature, Quadratic, Relaxation, ScaleDrift,
    ScaleTemperature, Step, Temperature, TemperatureQuadratic, TemperatureRate, ThermalHysteresis,
    Warmup,
};
use sensor::{AnyEffect, On, Param, Sensor, axes};

pub mod accel_cross_axis;
pub mod accel_hysteresis;
pub mod accel_periodic;
pub mod accel_room_field;
pub mod accel_vibration_rectification;
pub mod time_offset;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &on(Quadratic, "accel_quadratic", axes("1/(m/s^2)"), 1e-4),
    &on(Cubic, "accel_cubic", axes("1/(m/s^2)^2"), 1e-5),
    &on(Asymmetry, "accel_asymmetry", axes(""), 1e-3),
    &accel_cross_axis::AccelCrossAxis,
    &on(Drift, "accel_drift", axes("m/s^3"), 1.5e-5),
    &on(Warmup, "accel_warmup", Warmup::params("m/s^2"), 1e-2),
    &on(Temperature, "accel_temperature", axes("m/s^2/K"), 2e-3),
    &on(
        TemperatureQuadratic,
        "accel_temperature_quadratic",
        axes("m/s^2/K^2"),
        2e-4,
    )
    .with_companion("accel_temperature"),
    &on(
        ScaleTemperature,
        "accel_scale_temperature",
        axes("1/K"),
        2e-4,
    ),
    &on(Step, "accel_step", Step::params("m/s^2"), 5e-3),
    &accel_hysteresis::AccelHysteresis,
    &accel_vibration_rectification::AccelVibrationRectification,
    &on(
        MisalignmentTemperature,
        "accel_misalignment_temperature",
        MisalignmentTemperature::PARAMS,
        1e-4,
    ),
    &accel_periodic::AccelPeriodic,
    &on(
        Relaxation,
        "accel_relaxation",
        Relaxation::params("m/s^2"),
        5e-3,
    ),
    &accel_room_field::AccelRoomField,
    &on(
        TemperatureRate,
        "accel_temperature_rate",
        axes("m/s/K"),
        2e-1,
    ),
    &on(
        ThermalHysteresis,
        "accel_thermal_hysteresis",
        axes("m/s^2"),
        5e-3,
    ),
    &on(ScaleDrift, "accel_scale_drift", axes("1/s"), 3e-6),
    &time_offset::TimeOffset,
];

const fn on<E, const N: usize>(
    effect: E,
    name: &'static str,
    params: [Param; N],
    typical: f64,
) -> On<E, N> {
    On {
        effect,
        sensor: Sensor::Accelerometer,
        name,
        params,
        typical,
        companion: None,
    }
}
