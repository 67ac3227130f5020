//! Vibration rectification of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// Vibration shifts the mean reading: `eᵢ = kᵢ (rms_x² + rms_y² + rms_z²)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `k` | vibration rectification coefficient | (rad/s)/(m/s²)² | 3 |
/// | `rms²` | `Kinematics::vibration`: mean square of the vibration within the interval | (m/s²)² | 3 |
///
/// A recording shows it that has static intervals on a table that vibrates and others on one that does not. The axis of the
/// vibration that does it is not told apart: with one table it hardly changes.
#[derive(Clone, Copy, Debug)]
pub struct GyroVibrationRectification;

impl Effect for GyroVibrationRectification {
    const NAME: &'static str = "gyro_vibration_rectification";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += k_i rms² of the vibration";
    const PARAMS: &'static [Param] = &params("(rad/s)/(m/s^2)^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-4;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Vibration]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let square = truth.vibration.sum();
        Vector3::from_fn(|i, _| p[i] * square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_metre_per_second_squared_on_two_axes_shifts_by_half_the_coefficient() {
        let vibration = Vector3::new(0.25, 0.25, 0.0);
        let truth = Kinematics {
            vibration,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = GyroVibrationRectification.error(&truth, &[1e-3, 0.0, -2e-3]);
        assert!((e - Vector3::new(5e-4, 0.0, -1e-3)).norm() < 1e-18);
    }
}
