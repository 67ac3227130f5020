//! An error of an accelerometer that was proposed from data.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Sensor};
use solver::{Scalar, lit};

/// A sum of products in the reading of an accelerometer:
/// `e_x += x_fy_fz fy fz`
/// `e_z += z_fx_fy fx fy`
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `x_fy_fz` | coefficient on x | 1/(m/s^2) | 1 |
/// | `z_fx_fy` | coefficient on z | 1/(m/s^2) | 1 |
/// | `fx` | specific force | m/s² | 1 |
/// | `fy` | specific force | m/s² | 1 |
/// | `fz` | specific force | m/s² | 1 |
///
/// Source: selected by its fit to recordings, not derived from a model of the sensor.
#[derive(Clone, Copy, Debug)]
pub struct AccelProposed;

impl Effect for AccelProposed {
    const NAME: &'static str = "accel_proposed";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_x += x_fy_fz * fy * fz, A_z += z_fx_fy * fx * fy";
    const PARAMS: &'static [Param] = &[
        Param::new("x_fy_fz", "1/(m/s^2)", 0.0).sized(1.2e-4),
        Param::new("z_fx_fy", "1/(m/s^2)", 0.0).sized(8.0e-5),
    ];
    const TYPICAL: f64 = 1.2e-4;

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let mut e = Vector3::from_element(lit(0.0));
        e.x += p[0] * truth.specific_force.y * truth.specific_force.z;
        e.z += p[1] * truth.specific_force.x * truth.specific_force.y;
        e
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_term_is_its_coefficient_times_its_product() {
        let truth = Kinematics {
            time: 2.0,
            temperature: 28.0,
            angular_acceleration: Vector3::new(29.0, 31.0, 37.0),
            vibration: Vector3::new(17.0, 19.0, 23.0),
            last_change: Vector3::new(1.0, -1.0, 1.0),
            ..Kinematics::new(Vector3::new(2.0, 3.0, 5.0), Vector3::new(7.0, 11.0, 13.0))
        };
        let e = AccelProposed.error(&truth, &[1.0, 2.0]);
        let expected = Vector3::new(15.0, 0.0, 12.0);
        assert!((e - expected).norm() <= 1e-14 * expected.norm());
    }
}
