//! Accelerometer time stamps that are late.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Nature, Param, Quantity, Sensor};
use solver::Scalar;

/// The sample stamped `t` was taken at `t − d`: `e = −d ḟ`, to first order in `d`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `d` | delay of the accelerometer's time stamps against the gyroscope's | s | 1 |
/// | `ḟ` | derivative of the specific force | m/s³ | 3 |
///
/// It belongs to the accelerometer: the gyroscope's clock is the one that turns are integrated on. Only
/// the moving accelerometer shows it.
#[derive(Clone, Copy, Debug)]
pub struct TimeOffset;

impl Effect for TimeOffset {
    const NAME: &'static str = "time_offset";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "accelerometer stamps late by d";
    const PARAMS: &'static [Param] = &[Param::new("d", "s", 0.0)];
    const TYPICAL: f64 = 5e-3;
    const LINEAR: bool = true;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForceRate]);
    const NATURE: Nature = Nature::Delay;

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        truth.specific_force_rate.map(|rate| p[0] * (-rate))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_milliseconds_late_is_five_thousandths_of_the_rate() {
        let specific_force_rate = Vector3::new(2.0, 0.0, -4.0);
        let truth = Kinematics {
            specific_force_rate,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = TimeOffset.error(&truth, &[5e-3]);
        assert!((e - Vector3::new(-1e-2, 0.0, 2e-2)).norm() < 1e-15);
    }
}
