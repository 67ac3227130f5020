//! The true signal behind a reading.

use nalgebra::{Matrix3, Vector3};
use solver::scalar::{derivatives, variable};
use solver::{Jet, lit};

use crate::base::{Base, inverse};
use crate::effect::ModelScalar;
use crate::kinematics::Kinematics;
use crate::model::Model;

/// Fixed-point steps before Newton's method takes over. Most effects are below a hundredth of the
/// signal and done after five.
const FIXED_POINT_STEPS: usize = 8;
/// Newton steps at most. Two or three suffice for effects of a tenth of the signal; a reading that no
/// signal explains would go on for ever.
const NEWTON_STEPS: usize = 20;
/// A step below this share of the signal is rounding.
const SMALL: f64 = 1e-15;

impl Model {
    /// The corrected reading of `raw`: the signal `s` with `s + Σ effect(s) = T (raw − b)`.
    ///
    /// `rest` holds what else is known of the instant (the other sensor's signal, time,
    /// temperature); its value of this sensor's own signal is not used.
    pub fn correct<D: ModelScalar>(
        &self,
        raw: &Vector3<D>,
        rest: &Kinematics<D>,
        p: &[D],
    ) -> Vector3<D> {
        let base = Base::from_parameters(p).correct(raw);
        if self.effects().is_empty() {
            return base;
        }
        if self.is_apart_from_signal() {
            // Whatever the signal is, the effects are these.
            return base - self.error(rest, p);
        }
        signal_behind(self, &base, rest, p)
    }
}

/// The signal `s` with `s + Σ effect(s) = target`, with its derivatives.
///
/// `H = (I + ∂effect/∂s)⁻¹` at the solution is enough for the derivatives too: in
/// `s ← s − H (s + effect(s) − target)` every step makes one more order of them right.
fn signal_behind<D: ModelScalar>(
    model: &Model,
    target: &Vector3<D>,
    rest: &Kinematics<D>,
    p: &[D],
) -> Vector3<D> {
    let values: Vec<f64> = p.iter().map(|v| v.re()).collect();
    let problem = Problem {
        model,
        target: target.map(|v| v.re()),
        rest: rest.cast(),
        p: &values,
    };
    let value = problem.fixed_point().unwrap_or_else(|| problem.newton());
    let mut signal = value.map(lit::<D>);
    if D::ORDER == 0 {
        return signal;
    }
    let slope = problem.linearize(&value).1.map(lit::<D>);
    for _ in 0..D::ORDER {
        let error = model.error(&rest.with_signal(model.sensor(), signal), p);
        signal -= slope * (signal + error - target);
    }
    signal
}

/// The equation by values.
struct Problem<'a> {
    model: &'a Model,
    target: Vector3<f64>,
    rest: Kinematics<f64>,
    p: &'a [f64],
}

impl Problem<'_> {
    /// `s ← target − effect(s)`; `None` where that does not settle.
    fn fixed_point(&self) -> Option<Vector3<f64>> {
        let sensor = self.model.sensor();
        let mut signal = self.target;
        for _ in 0..FIXED_POINT_STEPS {
            let error = self
                .model
                .error(&self.rest.with_signal(sensor, signal), self.p);
            let next = self.target - error;
            let step = (next - signal).norm();
            signal = next;
            if step <= SMALL * signal.norm() {
                return Some(signal);
            }
        }
        None
    }

    fn newton(&self) -> Vector3<f64> {
        let mut signal = self.target;
        for _ in 0..NEWTON_STEPS {
            let (excess, slope) = self.linearize(&signal);
            let step = slope * excess;
            signal -= step;
            if step.norm() <= SMALL * signal.norm() || step.norm().is_nan() {
                break;
            }
        }
        signal
    }

    /// `s + effect(s) − target` and `H`; the identity stands in where `H` does not exist.
    fn linearize(&self, signal: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let p: Vec<Jet> = self.p.iter().map(|&v| lit(v)).collect();
        let lanes = Vector3::from_fn(|i, _| variable(signal[i], i));
        let truth = self.rest.cast().with_signal(self.model.sensor(), lanes);
        let reading = lanes + self.model.error(&truth, &p);
        let jacobian = Matrix3::from_fn(|i, j| derivatives(&reading[i])[j]);
        let slope = inverse(&jacobian).unwrap_or_else(Matrix3::identity);
        (reading.map(|v| v.re) - self.target, slope)
    }
}
