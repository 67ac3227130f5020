//! Temperature dependence of a magnetometer's bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

/// A bias that moves with temperature: `eᵢ = cᵢ (T − T₀)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | magnetometer error | µT | 3 |
/// | `c` | temperature coefficient of the bias | µT/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
#[derive(Clone, Copy, Debug)]
pub struct MagTemperature;

impl Effect for MagTemperature {
    const NAME: &'static str = "mag_temperature";
    const SENSOR: Sensor = Sensor::Magnetometer;
    const EQUATION: &'static str = "M_i += c_i (T - T0)";
    const PARAMS: &'static [Param] = &params("uT/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 0.05;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Temperature]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
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
        let e = MagTemperature.error(&truth, &[0.1, 0.0, -0.2]);
        assert!((e - Vector3::new(1.0, 0.0, -2.0)).norm() < 1e-15);
    }
}
