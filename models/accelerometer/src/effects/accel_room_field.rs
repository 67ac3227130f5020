//! Sensitivity of an accelerometer to a field that stands in the room.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Role, Sensor};
use solver::{Scalar, lit};

/// A field of the room, such as a magnetic one, seen by x and y otherwise than by z:
/// `eᵢ = aᵢ (Rᵀ x)ᵢ + bᵢ (Rᵀ y)ᵢ`, `x` and `y` horizontal.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `a`, `b` | response of the axes x and y to the field's two horizontal parts, less that of z | m/s² | 4 |
/// | `R` | `Kinematics::attitude`, from the body to the level frame | 1 | 3 × 3 |
///
/// A recording shows it that has orientations under several headings: a turn about the vertical changes it, which gravity
/// does not see. The vertical part of a field is a scale factor or a g-sensitivity. Its direction belongs to the recording.
/// What the three axes have in common is a tilt of the vertical, which no recording by hand shows: so all is relative to z.
#[derive(Clone, Copy, Debug)]
pub struct AccelRoomField;

impl Effect for AccelRoomField {
    const NAME: &'static str = "accel_room_field";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += a_i (R' x)_i + b_i (R' y)_i, i = x, y";
    const PARAMS: &'static [Param] = &[
        Param::new("ax", "m/s^2", 0.0).in_role(Role::Reference),
        Param::new("ay", "m/s^2", 0.0).in_role(Role::Reference),
        Param::new("bx", "m/s^2", 0.0).in_role(Role::Reference),
        Param::new("by", "m/s^2", 0.0).in_role(Role::Reference),
    ];
    const TYPICAL: f64 = 5e-3;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Attitude]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let [x, y] = [Vector3::x(), Vector3::y()].map(|h| truth.attitude.into_body(&h));
        let of = |i: usize| p[i] * lit::<D>(x[i]) + p[2 + i] * lit::<D>(y[i]);
        Vector3::new(of(0), of(1), lit(0.0))
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
        let p = [1e-3, 2e-3, 0.0, 5e-4];
        let e = AccelRoomField.error(&at(0.0), &p);
        assert!((e - Vector3::new(1e-3, 5e-4, 0.0)).norm() < 1e-16);
        let turned = AccelRoomField.error(&at(std::f64::consts::PI), &p);
        assert!((e + turned).norm() < 1e-15);
    }
}
