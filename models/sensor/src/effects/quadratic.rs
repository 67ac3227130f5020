//! Second-order nonlinearity.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics};

/// A reading that grows with the square of the signal: `eᵢ = kᵢ sᵢ²`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `k` | second-order coefficient (of an accelerometer 1e-4 is about 1 mg at 1 g) | 1/(m/s²) or 1/(rad/s) | 3 |
/// | `s` | signal: specific force or angular rate | m/s² or rad/s | 3 |
///
/// Source: the coefficient `K₂` of the model equation in IEEE Std 1293 (linear accelerometers).
#[derive(Clone, Copy, Debug)]
pub struct Quadratic;

impl CommonEffect for Quadratic {
    const EQUATION: &'static str = "{S}_i += k_i {s}_i²";
    const FORMULA: Option<&'static str> = Some("{i} * {s}{i}^2");

    fn error<D: Scalar>(signal: &Vector3<D>, _: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * signal[i] * signal[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_same_sign_both_ways() {
        let signal = Vector3::new(10.0, -2.0, 5.0);
        let at =
            |s: Vector3<f64>| Quadratic::error(&s, &Kinematics::at_rest(s), &[1e-4, 1e-3, -1e-4]);
        assert!((at(signal) - Vector3::new(1e-2, 4e-3, -2.5e-3)).norm() < 1e-15);
        assert_eq!(at(signal), at(-signal));
    }
}
