//! Acceleration sensitivity of a gyroscope.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, mat3, params};
use solver::Scalar;

/// Specific force leaks into the angular rate: `e = G f`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `G` | g-sensitivity (1 °/h/g ≈ 4.9e-7 s/m) | (rad/s)/(m/s²) | 3 × 3 |
/// | `f` | specific force | m/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroGSensitivity;

impl Effect for GyroGSensitivity {
    const NAME: &'static str = "gyro_g_sensitivity";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W += G f, G 3x3";
    const FORMULA: Option<&'static str> = Some("{i}x * fx + {i}y * fy + {i}z * fz");
    const PARAMS: &'static [Param] = &params(
        "rad/s/(m/s^2)",
        ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"],
    );

    const TYPICAL: f64 = 1e-4;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        mat3(p) * truth.specific_force
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_g_on_x_leaks_the_first_column() {
        let p = [1e-4, 0.0, 0.0, 2e-4, 0.0, 0.0, 3e-4, 0.0, 0.0];
        let e = GyroGSensitivity.error(&Kinematics::at_rest(Vector3::new(10.0, 0.0, 0.0)), &p);
        assert!((e - Vector3::new(1e-3, 2e-3, 3e-3)).norm() < 1e-18);
    }
}
