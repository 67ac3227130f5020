//! Temperature dependence of a bias.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity, REFERENCE_TEMPERATURE};

/// A bias that moves with temperature: `eᵢ = cᵢ (T − T₀)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | temperature coefficient of the bias | of the signal, per K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
#[derive(Clone, Copy, Debug)]
pub struct Temperature;

impl CommonEffect for Temperature {
    const EQUATION: &'static str = "{S}_i += c_i (T - T0)";
    const FORMULA: Option<&'static str> = Some("{i} * dT");
    const LINEAR: bool = true;
    const NEEDS: &'static [Quantity] = &[Quantity::Temperature];

    fn error<D: Scalar>(_: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * warmer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_kelvin_make_ten_times_the_coefficient() {
        let truth = Kinematics {
            temperature: 35.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = Temperature::error(&Vector3::zeros(), &truth, &[1e-3, 0.0, -2e-3]);
        assert!((e - Vector3::new(1e-2, 0.0, -2e-2)).norm() < 1e-15);
    }
}
