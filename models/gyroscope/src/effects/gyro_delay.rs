//! Delay of the axes of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Nature, Param, Quantity, Sensor, params};
use solver::Scalar;

/// Each axis reads what was `dᵢ` ago: `eᵢ = −dᵢ ω̇ᵢ`, to first order in `d`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `d` | delay of each axis after the earliest; what all three share is not visible in turns | s | 3 |
/// | `ω̇` | angular acceleration | rad/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroDelay;

impl Effect for GyroDelay {
    const NAME: &'static str = "gyro_delay";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i(t) = w_i(t - d_i), least d_i = 0";
    const PARAMS: &'static [Param] = &params("s", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-4;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::AngularAcceleration]);
    const NATURE: Nature = Nature::Delay;
    const REFERENCE: Option<&'static str> = Some("z");

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * (-truth.angular_acceleration[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_millisecond_late_is_a_thousandth_of_the_acceleration() {
        let angular_acceleration = Vector3::new(5.0, -5.0, 0.0);
        let truth = Kinematics {
            angular_acceleration,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = GyroDelay.error(&truth, &[1e-3, 1e-3, 1e-3]);
        assert!((e - Vector3::new(-5e-3, 5e-3, 0.0)).norm() < 1e-15);
    }
}
