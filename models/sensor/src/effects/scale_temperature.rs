//! Temperature dependence of a scale factor.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity, REFERENCE_TEMPERATURE};

/// A scale factor that moves with temperature: `eᵢ = cᵢ (T − T₀) sᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | temperature coefficient of the scale factor | 1/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `s` | signal: specific force, angular rate or magnetic field | m/s², rad/s or µT | 3 |
#[derive(Clone, Copy, Debug)]
pub struct ScaleTemperature;

impl CommonEffect for ScaleTemperature {
    const EQUATION: &'static str = "{S}_i += c_i (T - T0) {s}_i";
    const FORMULA: Option<&'static str> = Some("{i} * dT * {s}{i}");
    const NEEDS: &'static [Quantity] = &[Quantity::Temperature];

    fn error<D: Scalar>(signal: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * signal[i] * warmer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_kelvin_and_a_signal_of_two_make_twenty_coefficients() {
        let two = Vector3::new(2.0, -2.0, 0.0);
        let truth = Kinematics {
            temperature: 35.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = ScaleTemperature::error(&two, &truth, &[1e-4, 1e-4, 1e-4]);
        assert!((e - Vector3::new(2e-3, -2e-3, 0.0)).norm() < 1e-15);
    }
}
