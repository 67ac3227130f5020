//! The effects an accelerometer can have. A new one is a file here, its `mod` line and its registry line.

use sensor::AnyEffect;

mod accel_asymmetry;
mod accel_cross_axis;
mod accel_cubic;
mod accel_drift;
mod accel_hysteresis;
mod accel_misalignment_temperature;
mod accel_periodic;
mod accel_quadratic;
mod accel_relaxation;
mod accel_room_field;
mod accel_scale_temperature;
mod accel_step;
mod accel_temperature;
mod accel_temperature_quadratic;
mod accel_temperature_rate;
mod accel_thermal_hysteresis;
mod accel_vibration_rectification;
mod accel_warmup;
mod time_offset;

pub use accel_asymmetry::AccelAsymmetry;
pub use accel_cross_axis::AccelCrossAxis;
pub use accel_cubic::AccelCubic;
pub use accel_drift::AccelDrift;
pub use accel_hysteresis::AccelHysteresis;
pub use accel_misalignment_temperature::AccelMisalignmentTemperature;
pub use accel_periodic::AccelPeriodic;
pub use accel_quadratic::AccelQuadratic;
pub use accel_relaxation::AccelRelaxation;
pub use accel_room_field::AccelRoomField;
pub use accel_scale_temperature::AccelScaleTemperature;
pub use accel_step::AccelStep;
pub use accel_temperature::AccelTemperature;
pub use accel_temperature_quadratic::AccelTemperatureQuadratic;
pub use accel_temperature_rate::AccelTemperatureRate;
pub use accel_thermal_hysteresis::AccelThermalHysteresis;
pub use accel_vibration_rectification::AccelVibrationRectification;
pub use accel_warmup::AccelWarmup;
pub use time_offset::TimeOffset;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &AccelQuadratic,
    &AccelCubic,
    &AccelAsymmetry,
    &AccelCrossAxis,
    &AccelDrift,
    &AccelWarmup,
    &AccelTemperature,
    &AccelTemperatureQuadratic,
    &AccelScaleTemperature,
    &AccelStep,
    &AccelHysteresis,
    &AccelVibrationRectification,
    &AccelMisalignmentTemperature,
    &AccelPeriodic,
    &AccelRelaxation,
    &AccelRoomField,
    &AccelTemperatureRate,
    &AccelThermalHysteresis,
    &TimeOffset,
];
