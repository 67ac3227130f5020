//! Relaxation of a bias after a turn.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Param, Quantity, Role};

/// A part that yields while the device turns creeps back afterwards: `eᵢ = rᵢ sign(θᵢ) exp(−s/τ)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `r` | bias right after the turn | of the signal | 3 |
/// | `τ` | time constant, not 0 | s | 1 |
/// | `θ` | `Kinematics::last_turn`: rotation vector of the last turn; less than .1 about an axis counts as none | rad | 3 |
/// | `s` | `Kinematics::since_turn`: time since its end; of a mean, the mean of the decay | s | 1 |
///
/// A recording shows it whose static intervals are longer than `τ`, with turns both ways about each axis.
#[derive(Clone, Copy, Debug)]
pub struct Relaxation;

impl Relaxation {
    /// The time constant.
    pub const TAU: Param = Param::new("tau", "s", 3.0)
        .in_role(Role::TimeConstant)
        .tried_at(&[1.0, 2.0, 4.0, 8.0]);
}

impl CommonEffect for Relaxation {
    const EQUATION: &'static str = "{S}_i += r_i sign(last turn about i) exp(-s/tau)";
    const NEEDS: &'static [Quantity] = &[Quantity::LastTurn, Quantity::SinceTurn];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let left = truth.since_turn.decayed(p[3]);
        let way = truth.way_of_last_turn();
        Vector3::from_fn(|i, _| p[i] * left * way[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Since;

    #[test]
    fn after_one_time_constant_37_percent_are_left_on_the_axes_that_turned() {
        let truth = Kinematics {
            last_turn: Vector3::new(-1.5, 0.01, 0.7),
            since_turn: Since::at(2.0),
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = Relaxation::error(&Vector3::zeros(), &truth, &[1.0, 1.0, 2.0, 2.0]);
        let left = (-1.0_f64).exp();
        assert!((e - Vector3::new(-left, 0.0, 2.0 * left)).norm() < 1e-15);
    }
}
