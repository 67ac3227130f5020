//! Second-order nonlinearity of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A reading that grows with the square of the angular rate: `eᵢ = kᵢ ωᵢ²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `k` | second-order coefficient | 1/(rad/s) | 3 |
/// | `ω` | angular rate | rad/s | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroQuadratic;

impl Effect for GyroQuadratic {
    const NAME: &'static str = "gyro_quadratic";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += k_i w_i²";
    const FORMULA: Option<&'static str> = Some("{i} * w{i}^2");
    const PARAMS: &'static [Param] = &params("1/(rad/s)", ["x", "y", "z"]);
    const TYPICAL: f64 = 4e-4;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::AngularRate]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let w = &truth.angular_rate;
        Vector3::from_fn(|i, _| p[i] * w[i] * w[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_senses_of_rotation_read_too_much() {
        let e = GyroQuadratic.error(
            &Kinematics::new(Vector3::zeros(), Vector3::new(2.0, -1.0, 4.0)),
            &[1e-3, 1e-3, 1e-3],
        );
        assert!((e - Vector3::new(4e-3, 1e-3, 16e-3)).norm() < 1e-15);
    }
}
