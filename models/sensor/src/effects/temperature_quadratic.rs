//! Second-order temperature dependence of a bias.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity, REFERENCE_TEMPERATURE};

/// A bias that moves with the square of the temperature change: `eᵢ = cᵢ (T − T₀)²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | second-order temperature coefficient of the bias | of the signal, per K² | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
///
/// It comes with [`Temperature`](super::Temperature). A recording shows it whose temperature goes through a range, best up and down again:
/// over a short range it is a straight line, over a monotone one a warm-up.
#[derive(Clone, Copy, Debug)]
pub struct TemperatureQuadratic;

impl CommonEffect for TemperatureQuadratic {
    const EQUATION: &'static str = "{S}_i += c_i (T - T0)²";
    const FORMULA: Option<&'static str> = Some("{i} * dT^2");
    const LINEAR: bool = true;
    const NEEDS: &'static [Quantity] = &[Quantity::Temperature];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * (warmer * warmer))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_kelvin_either_way_make_a_hundred_times_the_coefficient() {
        let at = |temperature| {
            let truth = Kinematics {
                temperature,
                ..Kinematics::at_rest(Vector3::zeros())
            };
            TemperatureQuadratic::error(&Vector3::zeros(), &truth, &[1e-4, 0.0, -2e-4])
        };
        assert!((at(35.0) - Vector3::new(1e-2, 0.0, -2e-2)).norm() < 1e-15);
        assert_eq!(at(35.0), at(15.0));
    }
}
