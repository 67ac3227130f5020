//! Temperature dependence of a gyroscope bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

/// A bias that moves with temperature: `eᵢ = cᵢ (T − T₀)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | temperature coefficient of the bias | rad/s/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
#[derive(Clone, Copy, Debug)]
pub struct GyroTemperature;

impl Effect for GyroTemperature {
    const NAME: &'static str = "gyro_temperature";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i (T - T0)";
    const FORMULA: Option<&'static str> = Some("{i} * dT");
    const PARAMS: &'static [Param] = &params("rad/s/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-5;
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
        let e = GyroTemperature.error(&truth, &[1e-3, 0.0, -2e-3]);
        assert!((e - Vector3::new(1e-2, 0.0, -2e-2)).norm() < 1e-15);
    }
}
