//! Third-order nonlinearity.

use nalgebra::Vector3;
use solver::Scalar;

use crate::{CommonEffect, Kinematics};

/// A reading that grows with the cube of the signal: `eᵢ = kᵢ sᵢ³`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `k` | third-order coefficient | 1/(m/s²)² or 1/(rad/s)² | 3 |
/// | `s` | signal: specific force or angular rate | m/s² or rad/s | 3 |
///
/// Source: the coefficient `K₃` of the model equation in IEEE Std 1293 (linear accelerometers).
#[derive(Clone, Copy, Debug)]
pub struct Cubic;

impl CommonEffect for Cubic {
    const EQUATION: &'static str = "{S}_i += k_i {s}_i³";
    const FORMULA: Option<&'static str> = Some("{i} * {s}{i}^3");

    fn error<D: Scalar>(signal: &Vector3<D>, _: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        Vector3::from_fn(|i, _| p[i] * signal[i] * signal[i] * signal[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_changes_sign_with_the_signal() {
        let signal = Vector3::new(10.0, -2.0, 5.0);
        let e = Cubic::error(&signal, &Kinematics::at_rest(signal), &[1e-5, 1e-4, 0.0]);
        assert!((e - Vector3::new(1e-2, -8e-4, 0.0)).norm() < 1e-15);
    }
}
