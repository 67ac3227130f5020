//! The rotation of the earth, as a gyroscope sees it.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Nature, Param, Quantity, Role, Sensor};
use solver::Scalar;

/// Rate of the earth's rotation, rad/s (WGS 84).
pub const EARTH_RATE: f64 = 7.292_115e-5;

/// A gyroscope turns with the earth: `e = Rᵀ Ω`, `Ω = ω_E (0, cos L, sin L)` for y north and z up.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `Ω` | rotation of the earth in the level reference frame (`ω_E` = 7.292115e-5 rad/s, `L` latitude) | rad/s | 3 |
/// | `R` | `Kinematics::attitude`, from the body to the reference frame | 1 | 3 × 3 |
///
/// It belongs to the gyroscope and is not an error of it: angular rates here are relative to the earth.
/// Where the reference frame has another heading, `x` and `y` turn with it; `z` and the length remain.
#[derive(Clone, Copy, Debug)]
pub struct EarthRate;

impl Effect for EarthRate {
    const NAME: &'static str = "earth_rate";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "w += R' Omega(latitude)";
    const PARAMS: &'static [Param] = &[
        Param::new("x", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("y", "rad/s", 0.0).in_role(Role::Reference),
        Param::new("z", "rad/s", 0.0),
    ];
    const TYPICAL: f64 = EARTH_RATE;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Attitude]);
    const NATURE: Nature = Nature::EarthRotation;

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let omega = Vector3::new(p[0], p[1], p[2]);
        truth.attitude.lift().into_body(&omega)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use sensor::attitude::Attitude;

    #[test]
    fn upside_down_the_vertical_part_changes_sign() {
        let upside_down = Attitude::exp(&Vector3::new(std::f64::consts::PI, 0.0, 0.0));
        let truth = Kinematics {
            attitude: upside_down,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = EarthRate.error(&truth, &[0.0, 5e-5, 5e-5]);
        assert!((e - Vector3::new(0.0, -5e-5, -5e-5)).norm() < 1e-19);
    }
}
