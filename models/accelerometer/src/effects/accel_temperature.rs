//! Temperature dependence of an accelerometer bias.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

/// A bias that moves with temperature: `eᵢ = cᵢ (T − T₀)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | temperature coefficient of the bias | m/s²/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
#[derive(Clone, Copy, Debug)]
pub struct AccelTemperature;

impl Effect for AccelTemperature {
    const NAME: &'static str = "accel_temperature";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i (T - T0)";
    const FORMULA: Option<&'static str> = Some("{i} * dT");
    const PARAMS: &'static [Param] = &params("m/s^2/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 2e-3;
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
        let e = AccelTemperature.error(&truth, &[1e-3, 0.0, -2e-3]);
        assert!((e - Vector3::new(1e-2, 0.0, -2e-2)).norm() < 1e-15);
    }
}
