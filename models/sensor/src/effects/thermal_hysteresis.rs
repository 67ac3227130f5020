//! Thermal hysteresis.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity};

/// A bias that is another on the way up than on the way down: `eᵢ = hᵢ sign(last change of T)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `h` | half the width of the hysteresis | of the signal | 3 |
/// | `sign` | `Kinematics::warming`: 1 while it warms up, −1 while it cools, 0 before either | 1 | 1 |
///
/// A recording shows it that warms up and cools down, more than once best: of one change of direction it is a step.
#[derive(Clone, Copy, Debug)]
pub struct ThermalHysteresis;

impl CommonEffect for ThermalHysteresis {
    const EQUATION: &'static str = "{S}_i += h_i sign(last change of T)";
    const LINEAR: bool = true;
    const NEEDS: &'static [Quantity] = &[Quantity::Warming];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.warming)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_ways_are_twice_the_coefficient_apart() {
        let at = |warming| {
            let truth = Kinematics {
                warming,
                ..Kinematics::at_rest(Vector3::zeros())
            };
            ThermalHysteresis::error(&Vector3::zeros(), &truth, &[3e-3, 0.0, -1e-3])
        };
        assert_eq!(at(1.0) - at(-1.0), Vector3::new(6e-3, 0.0, -2e-3));
    }
}
