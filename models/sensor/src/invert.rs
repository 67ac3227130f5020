//! The true signal behind a reading: Newton's method on values, then the derivatives on top.

use nalgebra::{Matrix3, Vector3};
use solver::scalar::{derivatives, variable};
use solver::{Jet, lit};

use crate::base::inverse;
use crate::effect::ModelScalar;
use crate::kinematics::Kinematics;
use crate::model::Model;

/// Newton steps at most. Two or three suffice for effects of a tenth of the signal; a reading that no
/// signal explains would go on for ever.
const STEPS: usize = 20;
/// A step below this share of the signal is rounding.
const SMALL: f64 = 1e-15;

/// The signal `s` with `s + Σ effect(s) = target`, with its derivatives.
///
/// `H = (I + ∂effect/∂s)⁻¹` at the solution is enough for the derivatives too: in
/// `s ← s − H (s + effect(s) − target)` every step makes one more order of them right.
pub(crate) fn signal_behind<D: ModelScalar>(
    model: &Model,
    target: &Vector3<D>,
    rest: &Kinematics<D>,
    p: &[D],
) -> Vector3<D> {
    let values: Vec<Jet> = p.iter().map(|v| lit(v.re())).collect();
    let (signal, slope) = newton(model, &target.map(|v| v.re()), &rest.cast(), &values);
    let slope = slope.map(lit::<D>);
    let mut signal = signal.map(lit::<D>);
    for _ in 0..D::ORDER {
        let error = model.error(&rest.with_signal(model.sensor(), signal), p);
        signal -= slope * (signal + error - target);
    }
    signal
}

/// The signal and `H`, by values.
fn newton(
    model: &Model,
    target: &Vector3<f64>,
    rest: &Kinematics<Jet>,
    p: &[Jet],
) -> (Vector3<f64>, Matrix3<f64>) {
    let mut signal = *target;
    let mut slope = Matrix3::identity();
    for _ in 0..STEPS {
        let lanes = Vector3::from_fn(|i, _| variable(signal[i], i));
        let reading = lanes + model.error(&rest.with_signal(model.sensor(), lanes), p);
        let jacobian = Matrix3::from_fn(|i, j| derivatives(&reading[i])[j]);
        let Some(inverse) = inverse(&jacobian) else {
            break;
        };
        slope = inverse;
        let step = slope * (reading.map(|v| v.re) - target);
        signal -= step;
        if step.norm() <= SMALL * signal.norm() || step.norm().is_nan() {
            break;
        }
    }
    (signal, slope)
}
