//! Linear drift of a scale factor.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics, Quantity};

/// A scale factor that moves with time, as while the device warms up and no thermometer says so: `eᵢ = cᵢ t sᵢ`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | drift of the scale factor | 1/s | 3 |
/// | `t` | time since the start of the recording | s | 1 |
/// | `s` | signal: specific force or angular rate | m/s² or rad/s | 3 |
#[derive(Clone, Copy, Debug)]
pub struct ScaleDrift;

impl CommonEffect for ScaleDrift {
    const EQUATION: &'static str = "{S}_i += c_i t {s}_i";
    const FORMULA: Option<&'static str> = Some("{i} * t * {s}{i}");
    const NEEDS: &'static [Quantity] = &[Quantity::Time];

    fn error<D: Scalar>(signal: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * signal[i] * truth.time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_hundred_seconds_a_signal_of_two_is_off_by_two_hundred_drifts() {
        let two = Vector3::new(2.0, -2.0, 0.0);
        let truth = Kinematics {
            time: 100.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let e = ScaleDrift::error(&two, &truth, &[1e-6, 1e-6, 1e-6]);
        assert!((e - Vector3::new(2e-4, -2e-4, 0.0)).norm() < 1e-15);
    }
}
