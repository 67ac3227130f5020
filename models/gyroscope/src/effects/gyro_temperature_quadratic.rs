//! Second-order temperature dependence of a gyroscope bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

use super::gyro_temperature::GyroTemperature;

/// A bias that moves with the square of the temperature change: `eᵢ = cᵢ (T − T₀)²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | second-order temperature coefficient of the bias | rad/s/K² | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
///
/// A recording shows it whose temperature goes through a range, best up and down again: over a short range it is a
/// straight line, over a monotone one a warm-up.
#[derive(Clone, Copy, Debug)]
pub struct GyroTemperatureQuadratic;

impl Effect for GyroTemperatureQuadratic {
    const NAME: &'static str = "gyro_temperature_quadratic";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i (T - T0)²";
    const FORMULA: Option<&'static str> = Some("{i} * dT^2");
    const PARAMS: &'static [Param] = &params("rad/s/K^2", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-6;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Temperature]);
    const COMPANION: Option<&'static str> = Some(GyroTemperature::NAME);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * (warmer * warmer))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_kelvin_either_way_make_a_hundred_times_the_coefficient() {
        let at = |temperature| Kinematics {
            temperature,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let p = [1e-6, 0.0, -2e-6];
        let e = GyroTemperatureQuadratic.error(&at(35.0), &p);
        assert!((e - Vector3::new(1e-4, 0.0, -2e-4)).norm() < 1e-18);
        assert_eq!(e, GyroTemperatureQuadratic.error(&at(15.0), &p));
    }
}
