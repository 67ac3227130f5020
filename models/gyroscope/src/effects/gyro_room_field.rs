//! Sensitivity of a gyroscope to a field that stands in the room.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Role, Sensor};
use solver::{Scalar, lit};

/// A field of the room, such as a magnetic one, seen by each axis: `eᵢ = aᵢ (Rᵀ x)ᵢ + bᵢ (Rᵀ y)ᵢ`, `x` and `y` horizontal.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `a`, `b` | response of each axis to the field's two horizontal parts | rad/s | 6 |
/// | `R` | `Kinematics::attitude`, from the body to the level frame | 1 | 3 × 3 |
///
/// A recording shows it that has orientations under several headings: a turn about the vertical changes it, which gravity
/// does not see. The vertical part of a field is a scale factor or a g-sensitivity. Its direction belongs to the recording.
/// Alike on the three axes it is what the earth's rotation near the equator would be.
#[derive(Clone, Copy, Debug)]
pub struct GyroRoomField;

impl Effect for GyroRoomField {
    const NAME: &'static str = "gyro_room_field";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += a_i (R' x)_i + b_i (R' y)_i";
    const PARAMS: &'static [Param] = &[
        Param::new("ax", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("ay", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("az", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("bx", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("by", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("bz", "rad/s", 0.0).in_role(Role::Reference),
    ];
    const TYPICAL: f64 = 1e-4;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Attitude]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let [x, y] = [Vector3::x(), Vector3::y()].map(|h| truth.attitude.into_body(&h));
        Vector3::from_fn(|i, _| p[i] * lit::<D>(x[i]) + p[3 + i] * lit::<D>(y[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sensor::attitude::Attitude;

    #[test]
    fn half_a_turn_about_the_vertical_changes_its_sign() {
        let at = |heading| Kinematics {
            attitude: Attitude::exp(&Vector3::new(0.0, 0.0, heading)),
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let p = [1e-3, 2e-3, 0.0, 0.0, 5e-4, 1.0];
        let e = GyroRoomField.error(&at(0.0), &p);
        assert!((e - Vector3::new(1e-3, 5e-4, 0.0)).norm() < 1e-16);
        let turned = GyroRoomField.error(&at(std::f64::consts::PI), &p);
        assert!((e + turned).norm() < 1e-15);
    }
}
