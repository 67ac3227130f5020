//! Second-order nonlinearity of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A reading that grows with the square of the specific force: `eᵢ = kᵢ fᵢ²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `k` | second-order coefficient (1e-4 is about 1 mg at 1 g) | 1/(m/s²) | 3 |
/// | `f` | specific force | m/s² | 3 |
///
/// Source: the coefficient `K₂` of the model equation in IEEE Std 1293 (linear accelerometers).
#[derive(Clone, Copy, Debug)]
pub struct AccelQuadratic;

impl Effect for AccelQuadratic {
    const NAME: &'static str = "accel_quadratic";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += k_i f_i²";
    const FORMULA: Option<&'static str> = Some("{i} * f{i}^2");
    const PARAMS: &'static [Param] = &params("1/(m/s^2)", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-4;
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
    fn it_has_the_same_sign_up_and_down() {
        let (up, down) = (
            Kinematics::at_rest(Vector3::new(10.0, -2.0, 5.0)),
            Kinematics::at_rest(-Vector3::new(10.0, -2.0, 5.0)),
        );
        let p = [1e-4, 1e-3, -1e-4];
        let e = AccelQuadratic.error(&up, &p);
        assert!((e - Vector3::new(1e-2, 4e-3, -2.5e-3)).norm() < 1e-15);
        assert_eq!(e, AccelQuadratic.error(&down, &p));
    }
}
