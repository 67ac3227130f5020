//! Vibration rectification of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// Vibration shifts the mean reading: `eᵢ = kᵢ rmsᵢ²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `k` | vibration rectification coefficient | 1/(m/s²) | 3 |
/// | `rms²` | `Kinematics::vibration`: mean square of the vibration within the interval | (m/s²)² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct AccelVibrationRectification;

impl Effect for AccelVibrationRectification {
    const NAME: &'static str = "accel_vibration_rectification";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += k_i rms² of the vibration";
    const PARAMS: &'static [Param] = &params("1/(m/s^2)", ["x", "y", "z"]);
    const TYPICAL: f64 = 4e-2;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Vibration]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.vibration[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_metre_per_second_squared_shifts_by_a_quarter_of_the_coefficient() {
        let vibration = Vector3::new(0.25, 0.0, 1.0);
        let truth = Kinematics {
            vibration,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = AccelVibrationRectification.error(&truth, &[4e-2, 4e-2, 1e-2]);
        assert!((e - Vector3::new(1e-2, 0.0, 1e-2)).norm() < 1e-15);
    }
}
