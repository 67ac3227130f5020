//! A step in a bias.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Param, Quantity, Role};

/// A bias that jumps once: `eᵢ = cᵢ [t > t₀]`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | size of the jump | of the signal | 3 |
/// | `t₀` | instant of the jump | s | 1 |
/// | `t` | time since the start of the recording | s | 1 |
///
/// The derivative with respect to `t₀` is zero everywhere but at the jump: `t₀` has to be scanned, not
/// fitted.
#[derive(Clone, Copy, Debug)]
pub struct Step;

impl Step {
    /// The instant of the jump.
    pub const T0: Param = Param::new("t0", "s", 100.0).in_role(Role::Instant);
}

impl CommonEffect for Step {
    const EQUATION: &'static str = "{S}_i += c_i [t > t0]";
    const FORMULA: Option<&'static str> = Some("{i} * step(t - t0)");
    const NEEDS: &'static [Quantity] = &[Quantity::Time];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let jumped = if truth.time > p[3].re() { 1.0 } else { 0.0 };
        Vector3::from_fn(|i, _| p[i] * jumped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn before_the_jump_there_is_nothing() {
        let at = |time| {
            let truth = Kinematics {
                time,
                ..Kinematics::at_rest(Vector3::zeros())
            };
            Step::error(&Vector3::zeros(), &truth, &[1e-3, 0.0, -1e-3, 50.0])
        };
        assert_eq!(at(49.0), Vector3::zeros());
        assert_eq!(at(51.0), Vector3::new(1e-3, 0.0, -1e-3));
    }
}
