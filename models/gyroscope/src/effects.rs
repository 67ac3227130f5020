//! The effects a gyroscope can have. A new one is a file here, its `mod` line and its registry line.

use sensor::AnyEffect;

mod gyro_g_sensitivity;

pub use gyro_g_sensitivity::GyroGSensitivity;

/// The registry: feeds the command line, the documentation, the registry tests and discovery.
pub static EFFECTS: &[&dyn AnyEffect] = &[&GyroGSensitivity];
