//! The effects a gyroscope can have. A new one is a file here and two lines: its `pub mod` and its place in [`EFFECTS`].

use sensor::AnyEffect;

pub mod earth_rate;
pub mod gyro_asymmetry;
pub mod gyro_cubic;
pub mod gyro_delay;
pub mod gyro_drift;
pub mod gyro_g2_sensitivity;
pub mod gyro_g_sensitivity;
pub mod gyro_misalignment_temperature;
pub mod gyro_quadratic;
pub mod gyro_relaxation;
pub mod gyro_room_field;
pub mod gyro_scale_drift;
pub mod gyro_scale_temperature;
pub mod gyro_step;
pub mod gyro_temperature;
pub mod gyro_temperature_quadratic;
pub mod gyro_temperature_rate;
pub mod gyro_thermal_hysteresis;
pub mod gyro_vibration_rectification;
pub mod gyro_warmup;

/// The rotation of the earth, for those who know a latitude.
pub static EARTH_ROTATION: &dyn AnyEffect = &earth_rate::EarthRate;

/// The sensitivity to specific force, a matrix that formats of other programs hold too: `ω = T (W − b) − G f`.
pub static FORCE_SENSITIVITY: &dyn AnyEffect = &gyro_g_sensitivity::GyroGSensitivity;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &gyro_g_sensitivity::GyroGSensitivity,
    &gyro_g2_sensitivity::GyroG2Sensitivity,
    &gyro_drift::GyroDrift,
    &gyro_warmup::GyroWarmup,
    &gyro_temperature::GyroTemperature,
    &gyro_scale_temperature::GyroScaleTemperature,
    &gyro_step::GyroStep,
    &gyro_quadratic::GyroQuadratic,
    &gyro_cubic::GyroCubic,
    &gyro_asymmetry::GyroAsymmetry,
    &gyro_delay::GyroDelay,
    &gyro_misalignment_temperature::GyroMisalignmentTemperature,
    &gyro_relaxation::GyroRelaxation,
    &gyro_room_field::GyroRoomField,
    &gyro_temperature_quadratic::GyroTemperatureQuadratic,
    &gyro_temperature_rate::GyroTemperatureRate,
    &gyro_thermal_hysteresis::GyroThermalHysteresis,
    &gyro_vibration_rectification::GyroVibrationRectification,
    &gyro_scale_drift::GyroScaleDrift,
    &earth_rate::EarthRate,
];
