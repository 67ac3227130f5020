//! Kinematics of an instant that was not recorded.

use nalgebra::Vector3;
use sensor::Kinematics;

/// For models without effects, which look at nothing.
pub fn unneeded() -> Kinematics<f64> {
    supposed(Vector3::zeros(), Vector3::zeros())
}

/// An instant that nobody recorded: what would be if these were the signals (m/s², rad/s).
pub fn supposed(specific_force: Vector3<f64>, angular_rate: Vector3<f64>) -> Kinematics<f64> {
    Kinematics::new(specific_force, angular_rate)
}
