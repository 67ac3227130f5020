//! The effects a gyroscope can have. A new one is a file here, its `mod` line and its registry line.

use sensor::AnyEffect;

mod earth_rate;
mod gyro_asymmetry;
mod gyro_cubic;
mod gyro_delay;
mod gyro_drift;
mod gyro_g2_sensitivity;
mod gyro_g_sensitivity;
mod gyro_misalignment_temperature;
mod gyro_quadratic;
mod gyro_relaxation;
mod gyro_room_field;
mod gyro_scale_temperature;
mod gyro_step;
mod gyro_temperature;
mod gyro_temperature_quadratic;
mod gyro_temperature_rate;
mod gyro_thermal_hysteresis;
mod gyro_vibration_rectification;
mod gyro_warmup;

pub use earth_rate::{EARTH_RATE, EarthRate};
pub use gyro_asymmetry::GyroAsymmetry;
pub use gyro_cubic::GyroCubic;
pub use gyro_delay::GyroDelay;
pub use gyro_drift::GyroDrift;
pub use gyro_g_sensitivity::GyroGSensitivity;
pub use gyro_g2_sensitivity::GyroG2Sensitivity;
pub use gyro_misalignment_temperature::GyroMisalignmentTemperature;
pub use gyro_quadratic::GyroQuadratic;
pub use gyro_relaxation::GyroRelaxation;
pub use gyro_room_field::GyroRoomField;
pub use gyro_scale_temperature::GyroScaleTemperature;
pub use gyro_step::GyroStep;
pub use gyro_temperature::GyroTemperature;
pub use gyro_temperature_quadratic::GyroTemperatureQuadratic;
pub use gyro_temperature_rate::GyroTemperatureRate;
pub use gyro_thermal_hysteresis::GyroThermalHysteresis;
pub use gyro_vibration_rectification::GyroVibrationRectification;
pub use gyro_warmup::GyroWarmup;

/// The rotation of the earth, for those who know a latitude.
pub static EARTH_ROTATION: &dyn AnyEffect = &EarthRate;

/// The sensitivity to specific force, a matrix that formats of other programs hold too: `ω = T (W − b) − G f`.
pub static FORCE_SENSITIVITY: &dyn AnyEffect = &GyroGSensitivity;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[
    &GyroGSensitivity,
    &GyroG2Sensitivity,
    &GyroDrift,
    &GyroWarmup,
    &GyroTemperature,
    &GyroScaleTemperature,
    &GyroStep,
    &GyroQuadratic,
    &GyroCubic,
    &GyroAsymmetry,
    &GyroDelay,
    &GyroMisalignmentTemperature,
    &GyroRelaxation,
    &GyroRoomField,
    &GyroTemperatureQuadratic,
    &GyroTemperatureRate,
    &GyroThermalHysteresis,
    &GyroVibrationRectification,
    &EarthRate,
];
