//! Second-order temperature dependence of an accelerometer bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

use super::accel_temperature::AccelTemperature;

/// A bias that moves with the square of the temperature change: `eᵢ = cᵢ (T − T₀)²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | second-order temperature coefficient of the bias | m/s²/K² | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
#[derive(Clone, Copy, Debug)]
pub struct AccelTemperatureQuadratic;

impl Effect for AccelTemperatureQuadratic {
    const NAME: &'static str = "accel_temperature_quadratic";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i (T - T0)²";
    const FORMULA: Option<&'static str> = Some("{i} * dT^2");
    const PARAMS: &'static [Param] = &params("m/s^2/K^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 2e-4;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Temperature]);
    const COMPANION: Option<&'static str> = Some(AccelTemperature::NAME);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * (warmer * warmer))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_kelvin_make_a_hundred_times_the_coefficient() {
        let truth = Kinematics {
            temperature: 15.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = AccelTemperatureQuadratic.error(&truth, &[1e-4, 0.0, -2e-4]);
        assert!((e - Vector3::new(1e-2, 0.0, -2e-2)).norm() < 1e-15);
    }
}
