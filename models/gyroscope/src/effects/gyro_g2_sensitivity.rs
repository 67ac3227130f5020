//! Sensitivity of a gyroscope to the square of specific force.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// The square of the specific force leaks into the angular rate: `eᵢ = kᵢ fᵢ²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `k` | g²-sensitivity | (rad/s)/(m/s²)² | 3 |
/// | `f` | specific force | m/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroG2Sensitivity;

impl Effect for GyroG2Sensitivity {
    const NAME: &'static str = "gyro_g2_sensitivity";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += k_i f_i²";
    const FORMULA: Option<&'static str> = Some("{i} * f{i}^2");
    const PARAMS: &'static [Param] = &params("rad/s/(m/s^2)^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 2e-6;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let f = &truth.specific_force;
        Vector3::from_fn(|i, _| p[i] * f[i] * f[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_g_on_x_leaks_a_hundred_coefficients() {
        let e = GyroG2Sensitivity.error(
            &Kinematics::at_rest(Vector3::new(10.0, -2.0, 5.0)),
            &[2e-6, 1e-6, 0.0],
        );
        assert!((e - Vector3::new(2e-4, 4e-6, 0.0)).norm() < 1e-18);
    }
}
