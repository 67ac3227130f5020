//! Linear drift of a gyroscope bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A bias that moves with time: `eᵢ = cᵢ t`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | drift | rad/s² | 3 |
/// | `t` | time since the start of the recording | s | 1 |
#[derive(Clone, Copy, Debug)]
pub struct GyroDrift;

impl Effect for GyroDrift {
    const NAME: &'static str = "gyro_drift";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i t";
    const FORMULA: Option<&'static str> = Some("{i} * t");
    const PARAMS: &'static [Param] = &params("rad/s^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-7;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Time]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_hundred_seconds_it_is_a_hundred_times_the_drift() {
        let truth = Kinematics {
            time: 100.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = GyroDrift.error(&truth, &[1e-7, 0.0, -2e-7]);
        assert!((e - Vector3::new(1e-5, 0.0, -2e-5)).norm() < 1e-18);
    }
}
