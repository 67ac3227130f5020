//! Linear drift of a bias.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity};

/// A bias that moves with time: `eᵢ = cᵢ t`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | drift | of the signal, per s | 3 |
/// | `t` | time since the start of the recording | s | 1 |
#[derive(Clone, Copy, Debug)]
pub struct Drift;

impl CommonEffect for Drift {
    const EQUATION: &'static str = "{S}_i += c_i t";
    const FORMULA: Option<&'static str> = Some("{i} * t");
    const LINEAR: bool = true;
    const NEEDS: &'static [Quantity] = &[Quantity::Time];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
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
        let e = Drift::error(&Vector3::zeros(), &truth, &[1e-5, 0.0, -2e-5]);
        assert!((e - Vector3::new(1e-3, 0.0, -2e-3)).norm() < 1e-15);
    }
}
