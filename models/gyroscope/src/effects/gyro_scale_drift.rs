//! Linear drift of a gyroscope scale factor.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A scale factor that moves with time, as while the device warms up and no thermometer says so: `eᵢ = cᵢ t ωᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | drift of the scale factor | 1/s | 3 |
/// | `t` | time since the start of the recording | s | 1 |
/// | `ω` | angular rate | rad/s | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroScaleDrift;

impl Effect for GyroScaleDrift {
    const NAME: &'static str = "gyro_scale_drift";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i t w_i";
    const FORMULA: Option<&'static str> = Some("{i} * t * w{i}");
    const PARAMS: &'static [Param] = &params("1/s", ["x", "y", "z"]);
    const TYPICAL: f64 = 3e-6;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::AngularRate, Quantity::Time]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.angular_rate[i] * truth.time)
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
        let e = GyroScaleDrift.error(&truth, &[1e-6, 1e-6, 1e-6]);
        assert!((e - Vector3::new(2e-4, -2e-4, 0.0)).norm() < 1e-15);
    }
}
