//! Hysteresis of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// The reading depends on where the specific force came from: `eᵢ = hᵢ sign(last change of fᵢ)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `h` | half the width of the hysteresis | m/s² | 3 |
/// | `sign` | `Kinematics::last_change`: −1 or 1, 0 before the first change | 1 | 3 |
#[derive(Clone, Copy, Debug)]
pub struct AccelHysteresis;

impl Effect for AccelHysteresis {
    const NAME: &'static str = "accel_hysteresis";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += h_i sign(last change of f_i)";
    const PARAMS: &'static [Param] = &params("m/s^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 3e-3;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::LastChange]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.last_change[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_there_decides() {
        let last_change = Vector3::new(1.0, -1.0, 0.0);
        let truth = Kinematics {
            last_change,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = AccelHysteresis.error(&truth, &[3e-3, 3e-3, 3e-3]);
        assert!((e - Vector3::new(3e-3, -3e-3, 0.0)).norm() < 1e-15);
    }
}
