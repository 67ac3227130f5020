//! A step in the bias of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Role, Sensor};
use solver::Scalar;

/// A bias that jumps once: `eᵢ = cᵢ [t > t₀]`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | size of the jump | rad/s | 3 |
/// | `t₀` | instant of the jump | s | 1 |
/// | `t` | time since the start of the recording | s | 1 |
///
/// The derivative with respect to `t₀` is zero everywhere but at the jump: `t₀` has to be scanned, not
/// fitted.
#[derive(Clone, Copy, Debug)]
pub struct GyroStep;

impl Effect for GyroStep {
    const NAME: &'static str = "gyro_step";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i [t > t0]";
    const FORMULA: Option<&'static str> = Some("{i} * step(t - t0)");
    const PARAMS: &'static [Param] = &[
        Param::new("x", "rad/s", 0.0),
        Param::new("y", "rad/s", 0.0),
        Param::new("z", "rad/s", 0.0),
        Param::new("t0", "s", 100.0).in_role(Role::Instant),
    ];
    const TYPICAL: f64 = 2e-4;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Time]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let jumped = if truth.time > p[3].re() { 1.0 } else { 0.0 };
        Vector3::from_fn(|i, _| p[i] * jumped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn before_the_jump_there_is_nothing() {
        let at = |time| Kinematics {
            time,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let p = [1e-3, 0.0, -1e-3, 50.0];
        assert_eq!(GyroStep.error(&at(49.0), &p), Vector3::zeros());
        assert_eq!(
            GyroStep.error(&at(51.0), &p),
            Vector3::new(1e-3, 0.0, -1e-3)
        );
    }
}
