//! Warm-up of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Role, Sensor};
use solver::Scalar;

/// A bias that settles after the device is switched on: `eᵢ = cᵢ exp(−t/τ)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | bias at the start | m/s² | 3 |
/// | `τ` | time constant, not 0 | s | 1 |
/// | `t` | time since the start of the recording | s | 1 |
#[derive(Clone, Copy, Debug)]
pub struct AccelWarmup;

impl Effect for AccelWarmup {
    const NAME: &'static str = "accel_warmup";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i exp(-t/tau)";
    const FORMULA: Option<&'static str> = Some("{i} * exp(-t / tau)");
    const PARAMS: &'static [Param] = &[
        Param::new("x", "m/s^2", 0.0),
        Param::new("y", "m/s^2", 0.0),
        Param::new("z", "m/s^2", 0.0),
        Param::new("tau", "s", 120.0).in_role(Role::TimeConstant),
    ];
    const TYPICAL: f64 = 1e-2;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Time]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let decay = (p[3].recip() * (-truth.time)).exp();
        Vector3::from_fn(|i, _| p[i] * decay)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_one_time_constant_37_percent_are_left() {
        let truth = Kinematics {
            time: 60.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = AccelWarmup.error(&truth, &[1.0, 0.0, 0.0, 60.0]);
        assert!((e - Vector3::new((-1.0_f64).exp(), 0.0, 0.0)).norm() < 1e-15);
    }
}
