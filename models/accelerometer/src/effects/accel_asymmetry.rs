//! Scale factor asymmetry of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// Another scale factor for positive than for negative specific force: `eᵢ = kᵢ |fᵢ|`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `k` | half the difference of the two scale factors | 1 | 3 |
/// | `f` | specific force | m/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct AccelAsymmetry;

impl Effect for AccelAsymmetry {
    const NAME: &'static str = "accel_asymmetry";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += k_i |f_i|";
    const FORMULA: Option<&'static str> = Some("{i} * abs(f{i})");
    const PARAMS: &'static [Param] = &params("", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-3;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let f = &truth.specific_force;
        Vector3::from_fn(|i, _| {
            if f[i].re() < 0.0 {
                -p[i] * f[i]
            } else {
                p[i] * f[i]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_directions_read_too_much() {
        let e = AccelAsymmetry.error(
            &Kinematics::at_rest(Vector3::new(10.0, -2.0, 5.0)),
            &[1e-3, 1e-3, 0.0],
        );
        assert!((e - Vector3::new(1e-2, 2e-3, 0.0)).norm() < 1e-15);
    }
}
