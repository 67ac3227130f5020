//! Third-order nonlinearity of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A reading that grows with the cube of the specific force: `eᵢ = kᵢ fᵢ³`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `k` | third-order coefficient | 1/(m/s²)² | 3 |
/// | `f` | specific force | m/s² | 3 |
///
/// Source: the coefficient `K₃` of the model equation in IEEE Std 1293 (linear accelerometers).
#[derive(Clone, Copy, Debug)]
pub struct AccelCubic;

impl Effect for AccelCubic {
    const NAME: &'static str = "accel_cubic";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += k_i f_i³";
    const FORMULA: Option<&'static str> = Some("{i} * f{i}^3");
    const PARAMS: &'static [Param] = &params("1/(m/s^2)^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-5;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let f = &truth.specific_force;
        Vector3::from_fn(|i, _| p[i] * f[i] * f[i] * f[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_changes_sign_with_the_specific_force() {
        let e = AccelCubic.error(
            &Kinematics::at_rest(Vector3::new(10.0, -2.0, 5.0)),
            &[1e-5, 1e-4, 0.0],
        );
        assert!((e - Vector3::new(1e-2, -8e-4, 0.0)).norm() < 1e-15);
    }
}
