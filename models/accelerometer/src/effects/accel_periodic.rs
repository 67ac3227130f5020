//! Periodic nonlinearity of an accelerometer.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Role, Sensor};
use solver::{Scalar, lit};

/// An error that comes and goes as the reading grows, as of uneven codes of a converter: `eᵢ = aᵢ sin(2π fᵢ/P) + bᵢ
/// (cos(2π fᵢ/P) − 1)`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `a`, `b` | amplitudes | m/s² | 6 |
/// | `P` | period, not 0 | m/s² | 1 |
/// | `f` | specific force | m/s² | 3 |
///
/// A recording shows it that has many tilts between the faces, two for each period at least. Only periods below
/// .6 g are looked for: longer ones are made as well by an `accel_asymmetry` with an `accel_cubic`, as on a phone.
#[derive(Clone, Copy, Debug)]
pub struct AccelPeriodic;

impl Effect for AccelPeriodic {
    const NAME: &'static str = "accel_periodic";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += a_i sin(2π f_i/P) + b_i (cos(2π f_i/P) - 1)";
    const FORMULA: Option<&'static str> =
        Some("a{i} * sin(2*pi * f{i} / period) + b{i} * (cos(2*pi * f{i} / period) - 1)");
    const PARAMS: &'static [Param] = &[
        Param::new("ax", "m/s^2", 0.0),
        Param::new("ay", "m/s^2", 0.0),
        Param::new("az", "m/s^2", 0.0),
        Param::new("bx", "m/s^2", 0.0),
        Param::new("by", "m/s^2", 0.0),
        Param::new("bz", "m/s^2", 0.0),
        Param::new("period", "m/s^2", 4.5)
            .in_role(Role::Shape)
            .tried_at(&[5.5, 5.0, 4.5, 4.1, 3.7, 3.3]),
    ];
    const TYPICAL: f64 = 5e-3;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let per = p[6].recip() * lit::<D>(TAU);
        Vector3::from_fn(|i, _| {
            let angle = truth.specific_force[i] * per;
            p[i] * angle.sin() + p[3 + i] * (angle.cos() - lit::<D>(1.0))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_further_it_is_the_same() {
        let p = [1e-3, 2e-3, 0.0, 0.0, 1e-3, 3e-3, 4.0];
        let at = |f| AccelPeriodic.error(&Kinematics::at_rest(f), &p);
        let e = at(Vector3::new(1.0, -1.0, 2.0));
        assert!((e - Vector3::new(1e-3, -3e-3, -6e-3)).norm() < 1e-17);
        assert!((e - at(Vector3::new(5.0, 3.0, -2.0))).norm() < 1e-15);
    }
}
