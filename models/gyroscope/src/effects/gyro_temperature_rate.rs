//! Dependence of a gyroscope bias on how fast the temperature changes.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A bias that follows the temperature's derivative, as where one side of a package warms before the other:
/// `eᵢ = cᵢ dT/dt`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | coefficient | (rad/s)/(K/s) | 3 |
/// | `dT/dt` | `Kinematics::temperature_rate` | K/s | 1 |
///
/// A recording shows it that passes the same temperature warming up and cooling down. While the temperature settles in one
/// exponential, its derivative, the temperature and a warm-up are one curve.
#[derive(Clone, Copy, Debug)]
pub struct GyroTemperatureRate;

impl Effect for GyroTemperatureRate {
    const NAME: &'static str = "gyro_temperature_rate";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += c_i dT/dt";
    const PARAMS: &'static [Param] = &params("rad/K", ["x", "y", "z"]);
    const TYPICAL: f64 = 5e-3;
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
        let e = GyroTemperatureRate.error(&at(0.05), &p);
        assert!((e - Vector3::new(5e-3, 0.0, -1e-2)).norm() < 1e-17);
        assert_eq!(e, -GyroTemperatureRate.error(&at(-0.05), &p));
    }
}
