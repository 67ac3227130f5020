//! Linear drift of an accelerometer scale factor.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A scale factor that moves with time, as while the device warms up and no thermometer says so: `eᵢ = cᵢ t fᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | drift of the scale factor | 1/s | 3 |
/// | `t` | time since the start of the recording | s | 1 |
/// | `f` | specific force | m/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct AccelScaleDrift;

impl Effect for AccelScaleDrift {
    const NAME: &'static str = "accel_scale_drift";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i t f_i";
    const FORMULA: Option<&'static str> = Some("{i} * t * f{i}");
    const PARAMS: &'static [Param] = &params("1/s", ["x", "y", "z"]);
    const TYPICAL: f64 = 3e-6;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce, Quantity::Time]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.specific_force[i] * truth.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_hundred_seconds_a_signal_of_two_is_off_by_two_hundred_drifts() {
        let two = Vector3::new(2.0, -2.0, 0.0);
        let truth = Kinematics {
            time: 100.0,
            ..Kinematics::new(two, two)
        };
        let e = AccelScaleDrift.error(&truth, &[1e-6, 1e-6, 1e-6]);
        assert!((e - Vector3::new(2e-4, -2e-4, 0.0)).norm() < 1e-15);
    }
}
