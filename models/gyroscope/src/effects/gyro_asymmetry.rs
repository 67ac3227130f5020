//! Scale factor asymmetry of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// Another scale factor for one sense of rotation than for the other: `eᵢ = kᵢ |ωᵢ|`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `k` | half the difference of the two scale factors | 1 | 3 |
/// | `ω` | angular rate | rad/s | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroAsymmetry;

impl Effect for GyroAsymmetry {
    const NAME: &'static str = "gyro_asymmetry";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += k_i |w_i|";
    const FORMULA: Option<&'static str> = Some("{i} * abs(w{i})");
    const PARAMS: &'static [Param] = &params("", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-4;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::AngularRate]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let w = &truth.angular_rate;
        Vector3::from_fn(|i, _| {
            if w[i].re() < 0.0 {
                -p[i] * w[i]
            } else {
                p[i] * w[i]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_senses_of_rotation_read_too_much() {
        let e = GyroAsymmetry.error(
            &Kinematics::new(Vector3::zeros(), Vector3::new(2.0, -1.0, 4.0)),
            &[1e-3, 1e-3, 1e-3],
        );
        assert!((e - Vector3::new(2e-3, 1e-3, 4e-3)).norm() < 1e-15);
    }
}
