//! Temperature dependence of a gyroscope scale factor.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

/// A scale factor that moves with temperature: `eᵢ = cᵢ (T − T₀) ωᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | temperature coefficient of the scale factor | 1/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `ω` | angular rate | rad/s | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroScaleTemperature;

impl Effect for GyroScaleTemperature {
    const NAME: &'static str = "gyro_scale_temperature";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i (T - T0) w_i";
    const FORMULA: Option<&'static str> = Some("{i} * dT * w{i}");
    const PARAMS: &'static [Param] = &params("1/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 2e-4;
    const NEEDS: Option<&'static [Quantity]> =
        Some(&[Quantity::AngularRate, Quantity::Temperature]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * truth.angular_rate[i] * warmer)
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
        let e = GyroScaleTemperature.error(&truth, &[1e-4, 1e-4, 1e-4]);
        assert!((e - Vector3::new(2e-3, -2e-3, 0.0)).norm() < 1e-15);
    }
}
