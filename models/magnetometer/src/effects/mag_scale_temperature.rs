//! Temperature dependence of a magnetometer's scale factors.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, params};
use solver::Scalar;

/// Scale factors that move with temperature: `eᵢ = cᵢ (T − T₀) mᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | magnetometer error | µT | 3 |
/// | `c` | temperature coefficient of the scale factor | 1/K | 3 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `m` | magnetic field | µT | 3 |
#[derive(Clone, Copy, Debug)]
pub struct MagScaleTemperature;

impl Effect for MagScaleTemperature {
    const NAME: &'static str = "mag_scale_temperature";
    const SENSOR: Sensor = Sensor::Magnetometer;
    const EQUATION: &'static str = "M_i += c_i (T - T0) m_i";
    const PARAMS: &'static [Param] = &params("1/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-3;
    const NEEDS: Option<&'static [Quantity]> =
        Some(&[Quantity::MagneticField, Quantity::Temperature]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        Vector3::from_fn(|i, _| p[i] * truth.magnetic_field[i] * warmer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warmer_sensor_reads_more_of_a_strong_field() {
        let truth = Kinematics {
            temperature: 35.0,
            magnetic_field: Vector3::new(20.0, 0.0, -40.0),
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = MagScaleTemperature.error(&truth, &[1e-3, 1e-3, 1e-3]);
        assert!((e - Vector3::new(0.2, 0.0, -0.4)).norm() < 1e-15);
    }
}
