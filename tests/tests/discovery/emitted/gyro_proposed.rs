//! An error of a gyroscope that was proposed from data.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, REFERENCE_TEMPERATURE, Sensor};
use solver::{Scalar, lit};

/// A sum of products in the reading of a gyroscope:
/// `e_x += x_fx2_wz3 fx^2 wz^3`
/// `e_x += x_dt_wz dT wz`
/// `e_y += y_t2 t^2`
/// `e_y += y_changex changex`
/// `e_z += z_dt2_alphay2 dT^2 alphay^2`
/// `e_z += z_vibrationz vibrationz`
/// `e_z += z_temp T`
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `x_fx2_wz3` | coefficient on x | 1/(m/s^2)^2/(rad/s)^2 | 1 |
/// | `x_dt_wz` | coefficient on x | 1/K | 1 |
/// | `y_t2` | coefficient on y | rad/s/s^2 | 1 |
/// | `y_changex` | coefficient on y | rad/s | 1 |
/// | `z_dt2_alphay2` | coefficient on z | rad/s/(rad/s^2)^2/K^2 | 1 |
/// | `z_vibrationz` | coefficient on z | rad/s/(m/s^2)^2 | 1 |
/// | `z_temp` | coefficient on z | rad/s/K | 1 |
/// | `fx` | specific force | m/s² | 1 |
/// | `wz` | angular rate | rad/s | 1 |
/// | `alphay` | angular acceleration | rad/s² | 1 |
/// | `vibrationz` | mean square of the vibration | (m/s²)² | 1 |
/// | `changex` | sign of the last change of specific force | 1 | 1 |
/// | `t` | time | s | 1 |
/// | `T` | temperature | °C | 1 |
/// | `dT` | temperature less `REFERENCE_TEMPERATURE` | K | 1 |
///
/// Source: selected by its fit to recordings, not derived from a model of the sensor.
#[derive(Clone, Copy, Debug)]
pub struct GyroProposed;

impl Effect for GyroProposed {
    const NAME: &'static str = "gyro_proposed";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_x += x_fx2_wz3 * fx^2 * wz^3 + x_dt_wz * dT * wz, \
        W_y += y_t2 * t^2 + y_changex * changex, \
        W_z += z_dt2_alphay2 * dT^2 * alphay^2 + z_vibrationz * vibrationz + z_temp * T";
    const PARAMS: &'static [Param] = &[
        Param::new("x_fx2_wz3", "1/(m/s^2)^2/(rad/s)^2", 0.0).sized(3.0e-7),
        Param::new("x_dt_wz", "1/K", 0.0).sized(2.0e-4),
        Param::new("y_t2", "rad/s/s^2", 0.0).sized(1.0e-9),
        Param::new("y_changex", "rad/s", 0.0).sized(1.0e-4),
        Param::new("z_dt2_alphay2", "rad/s/(rad/s^2)^2/K^2", 0.0).sized(5.0e-7),
        Param::new("z_vibrationz", "rad/s/(m/s^2)^2", 0.0).sized(1.0e-3),
        Param::new("z_temp", "rad/s/K", 0.0).sized(1.0e-6),
    ];
    const TYPICAL: f64 = 3.0e-7;

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let mut e = Vector3::from_element(lit(0.0));
        e.x += p[0]
            * truth.specific_force.x
            * truth.specific_force.x
            * truth.angular_rate.z
            * truth.angular_rate.z
            * truth.angular_rate.z;
        e.x += p[1] * (truth.temperature - REFERENCE_TEMPERATURE) * truth.angular_rate.z;
        e.y += p[2] * truth.time * truth.time;
        e.y += p[3] * truth.last_change.x;
        e.z += p[4]
            * (truth.temperature - REFERENCE_TEMPERATURE)
            * (truth.temperature - REFERENCE_TEMPERATURE)
            * truth.angular_acceleration.y
            * truth.angular_acceleration.y;
        e.z += p[5] * truth.vibration.z;
        e.z += p[6] * truth.temperature;
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
        let e = GyroProposed.error(&truth, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        let expected = Vector3::new(8866.0, 16.0, 43579.0);
        assert!((e - expected).norm() <= 1e-14 * expected.norm());
    }
}
