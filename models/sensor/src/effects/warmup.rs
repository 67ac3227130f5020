//! Warm-up of a bias.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Param, Quantity, Role};

/// A bias that settles after the device is switched on: `eᵢ = cᵢ exp(−t/τ)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | bias at the start | of the signal | 3 |
/// | `τ` | time constant, not 0 | s | 1 |
/// | `t` | time since the start of the recording | s | 1 |
#[derive(Clone, Copy, Debug)]
pub struct Warmup;

impl Warmup {
    /// The time constant.
    pub const TAU: Param = Param::new("tau", "s", 120.0).in_role(Role::TimeConstant);
}

impl CommonEffect for Warmup {
    const EQUATION: &'static str = "{S}_i += c_i exp(-t/tau)";
    const FORMULA: Option<&'static str> = Some("{i} * exp(-t / tau)");
    const NEEDS: &'static [Quantity] = &[Quantity::Time];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
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
        let e = Warmup::error(&Vector3::zeros(), &truth, &[1.0, 0.0, 0.0, 60.0]);
        assert!((e - Vector3::new((-1.0_f64).exp(), 0.0, 0.0)).norm() < 1e-15);
    }
}
