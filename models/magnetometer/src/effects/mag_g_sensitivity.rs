//! Acceleration sensitivity of a magnetometer.

use nalgebra::{Matrix3, Vector3};
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// Specific force leaks into the magnetic field: `e = G f`, such as by a part that bends under its weight.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | magnetometer error | µT | 3 |
/// | `G` | g-sensitivity, of trace 0 | µT/(m/s²) | 3 × 3 |
/// | `f` | specific force | m/s² | 3 |
///
/// A multiple of `f` is at rest a vertical field that turns with the room: no recording tells it from the inclination of the
/// place. `G` therefore has eight parameters, and `G_zz = −(G_xx + G_yy)`.
#[derive(Clone, Copy, Debug)]
pub struct MagGSensitivity;

impl Effect for MagGSensitivity {
    const NAME: &'static str = "mag_g_sensitivity";
    const SENSOR: Sensor = Sensor::Magnetometer;
    const EQUATION: &'static str = "M += G f, G 3x3 of trace 0";
    const PARAMS: &'static [Param] = &params(
        "uT/(m/s^2)",
        ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy"],
    );
    const TYPICAL: f64 = 0.03;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let last = -(p[0] + p[4]);
        let g = Matrix3::from_fn(|i, j| p.get(3 * i + j).copied().unwrap_or(last));
        g * truth.specific_force
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_trace_is_zero() {
        let p = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08];
        let error = |f: Vector3<f64>| MagGSensitivity.error(&Kinematics::at_rest(f), &p);
        assert_eq!(error(Vector3::x()), Vector3::new(0.01, 0.04, 0.07));
        let trace = error(Vector3::x()).x + error(Vector3::y()).y + error(Vector3::z()).z;
        assert!(trace.abs() < 1e-17);
    }
}
