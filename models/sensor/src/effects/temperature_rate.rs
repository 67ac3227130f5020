//! Dependence of a bias on how fast the temperature changes.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity};

/// A bias that follows the temperature's derivative, as where one side of a package warms before the other:
/// `eᵢ = cᵢ dT/dt`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | coefficient | of the signal, per K/s | 3 |
/// | `dT/dt` | `Kinematics::temperature_rate` | K/s | 1 |
///
/// A recording shows it that passes the same temperature warming up and cooling down. While the temperature settles in one
/// exponential, its derivative, the temperature and a warm-up are one curve.
#[derive(Clone, Copy, Debug)]
pub struct TemperatureRate;

impl CommonEffect for TemperatureRate {
    const EQUATION: &'static str = "{S}_i += c_i dT/dt";
    const LINEAR: bool = true;
    const NEEDS: &'static [Quantity] = &[Quantity::TemperatureRate];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.temperature_rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cooling_changes_its_sign() {
        let at = |temperature_rate| {
            let truth = Kinematics {
                temperature_rate,
                ..Kinematics::at_rest(Vector3::zeros())
            };
            TemperatureRate::error(&Vector3::zeros(), &truth, &[0.1, 0.0, -0.2])
        };
        assert!((at(0.05) - Vector3::new(5e-3, 0.0, -1e-2)).norm() < 1e-17);
        assert_eq!(at(0.05), -at(-0.05));
    }
}
