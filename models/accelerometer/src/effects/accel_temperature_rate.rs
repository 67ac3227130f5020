//! Dependence of an accelerometer bias on how fast the temperature changes.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A bias that follows the temperature's derivative, as where one side of a package warms before the other:
/// `eᵢ = cᵢ dT/dt`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | coefficient | (m/s²)/(K/s) | 3 |
/// | `dT/dt` | `Kinematics::temperature_rate` | K/s | 1 |
///
/// A recording shows it that passes the same temperature warming up and cooling down. While the temperature settles in one
/// exponential, its derivative, the temperature and a warm-up are one curve.
#[derive(Clone, Copy, Debug)]
pub struct AccelTemperatureRate;

impl Effect for AccelTemperatureRate {
    const NAME: &'static str = "accel_temperature_rate";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += c_i dT/dt";
    const PARAMS: &'static [Param] = &params("m/s/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 2e-1;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::TemperatureRate]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.temperature_rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cooling_changes_its_sign() {
        let at = |temperature_rate| Kinematics {
            temperature_rate,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let p = [0.1, 0.0, -0.2];
        let e = AccelTemperatureRate.error(&at(0.05), &p);
        assert!((e - Vector3::new(5e-3, 0.0, -1e-2)).norm() < 1e-17);
        assert_eq!(e, -AccelTemperatureRate.error(&at(-0.05), &p));
    }
}
