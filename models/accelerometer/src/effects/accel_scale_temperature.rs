//! Temperature dependence of an accelerometer scale factor.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

/// A scale factor that moves with temperature: `eᵢ = cᵢ (T − T₀) fᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | temperature coefficient of the scale factor | 1/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `f` | specific force | m/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct AccelScaleTemperature;

impl Effect for AccelScaleTemperature {
    const NAME: &'static str = "accel_scale_temperature";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i (T - T0) f_i";
    const FORMULA: Option<&'static str> = Some("{i} * dT * f{i}");
    const PARAMS: &'static [Param] = &params("1/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 2e-4;
    const NEEDS: Option<&'static [Quantity]> =
        Some(&[Quantity::SpecificForce, Quantity::Temperature]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * truth.specific_force[i] * warmer)
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
            ..Kinematics::new(two, two)
        };
        let e = AccelScaleTemperature.error(&truth, &[1e-4, 1e-4, 1e-4]);
        assert!((e - Vector3::new(2e-3, -2e-3, 0.0)).norm() < 1e-15);
    }
}
