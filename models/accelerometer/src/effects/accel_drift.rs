//! Linear drift of an accelerometer bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A bias that moves with time: `eᵢ = cᵢ t`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | drift | m/s³ | 3 |
/// | `t` | time since the start of the recording | s | 1 |
#[derive(Clone, Copy, Debug)]
pub struct AccelDrift;

impl Effect for AccelDrift {
    const NAME: &'static str = "accel_drift";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i t";
    const FORMULA: Option<&'static str> = Some("{i} * t");
    const PARAMS: &'static [Param] = &params("m/s^3", ["x", "y", "z"]);
    const TYPICAL: f64 = 1.5e-5;
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
        let e = AccelDrift.error(&truth, &[1e-5, 0.0, -2e-5]);
        assert!((e - Vector3::new(1e-3, 0.0, -2e-3)).norm() < 1e-15);
    }
}
