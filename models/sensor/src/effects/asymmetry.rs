//! Scale factor asymmetry.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics};

/// Another scale factor for a positive than for a negative signal: `eᵢ = kᵢ |sᵢ|`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `k` | half the difference of the two scale factors | 1 | 3 |
/// | `s` | signal: specific force or angular rate | m/s² or rad/s | 3 |
#[derive(Clone, Copy, Debug)]
pub struct Asymmetry;

impl CommonEffect for Asymmetry {
    const EQUATION: &'static str = "{S}_i += k_i |{s}_i|";
    const FORMULA: Option<&'static str> = Some("{i} * abs({s}{i})");

    fn error<D: Scalar>(signal: &Vector3<D>, _: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| {
            if signal[i].re() < 0.0 {
                -p[i] * signal[i]
            } else {
                p[i] * signal[i]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_directions_read_too_much() {
        let signal = Vector3::new(10.0, -2.0, 5.0);
        let e = Asymmetry::error(&signal, &Kinematics::at_rest(signal), &[1e-3, 1e-3, 0.0]);
        assert!((e - Vector3::new(1e-2, 2e-3, 0.0)).norm() < 1e-15);
    }
}
