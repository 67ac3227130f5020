//! The effects an accelerometer can have. A new one is a file here and two lines: its `pub mod` and its place in [`EFFECTS`].

use sensor::AnyEffect;

pub mod accel_asymmetry;
pub mod accel_cross_axis;
pub mod accel_cubic;
pub mod accel_drift;
pub mod accel_hysteresis;
pub mod accel_misalignment_temperature;
pub mod accel_periodic;
pub mod accel_quadratic;
pub mod accel_relaxation;
pub mod accel_room_field;
pub mod accel_scale_drift;
pub mod accel_scale_temperature;
pub mod accel_step;
pub mod accel_temperature;
pub mod accel_temperature_quadratic;
pub mod accel_temperature_rate;
pub mod accel_thermal_hysteresis;
pub mod accel_vibration_rectification;
pub mod accel_warmup;
pub mod time_offset;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &accel_quadratic::AccelQuadratic,
    &accel_cubic::AccelCubic,
    &accel_asymmetry::AccelAsymmetry,
    &accel_cross_axis::AccelCrossAxis,
    &accel_drift::AccelDrift,
    &accel_warmup::AccelWarmup,
    &accel_temperature::AccelTemperature,
    &accel_temperature_quadratic::AccelTemperatureQuadratic,
    &accel_scale_temperature::AccelScaleTemperature,
    &accel_step::AccelStep,
    &accel_hysteresis::AccelHysteresis,
    &accel_vibration_rectification::AccelVibrationRectification,
    &accel_misalignment_temperature::AccelMisalignmentTemperature,
    &accel_periodic::AccelPeriodic,
    &accel_relaxation::AccelRelaxation,
    &accel_room_field::AccelRoomField,
    &accel_temperature_rate::AccelTemperatureRate,
    &accel_thermal_hysteresis::AccelThermalHysteresis,
    &accel_scale_drift::AccelScaleDrift,
    &time_offset::TimeOffset,
];
