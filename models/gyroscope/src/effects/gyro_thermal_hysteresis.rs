//! Thermal hysteresis of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// A bias that is another on the way up than on the way down: `eᵢ = hᵢ sign(last change of T)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `h` | half the width of the hysteresis | rad/s | 3 |
/// | `sign` | `Kinematics::warming`: 1 while it warms up, −1 while it cools, 0 before either | 1 | 1 |
///
/// A recording shows it that warms up and cools down, more than once best: of one change of direction it is a step.
#[derive(Clone, Copy, Debug)]
pub struct GyroThermalHysteresis;

impl Effect for GyroThermalHysteresis {
    const NAME: &'static str = "gyro_thermal_hysteresis";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += h_i sign(last change of T)";
    const PARAMS: &'static [Param] = &params("rad/s", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-4;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Warming]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * truth.warming)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_ways_are_twice_the_coefficient_apart() {
        let at = |warming| Kinematics {
            warming,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let p = [3e-3, 0.0, -1e-3];
        let [up, down] = [1.0, -1.0].map(|sign| GyroThermalHysteresis.error(&at(sign), &p));
        assert_eq!(up - down, Vector3::new(6e-3, 0.0, -2e-3));
    }
}
