//! The derivative of the true signal behind a reading, against given vectors.

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Base, EffectRef, Kinematics, Model, PLACES, Sensor, inverse};
use solver::scalar::{derivatives, variable};
use solver::{Jet, LANES, lit};

/// Sums of `hᵀ ∂ω/∂p` over samples, for two vectors per sample.
///
/// The signal `s` solves `s + e(s, p) = T (x − b)`, so that
/// `∂s = (I + ∂e/∂s)⁻¹ (∂T (x − b) − T ∂b − ∂e/∂p)`. Dual numbers run over the signal and the free
/// parameters of one effect at a time; the base is linear and needs none.
pub(super) struct Sensitivity<'a> {
    base: Base<f64>,
    effects: Vec<Active<'a>>,
    free: &'a [usize],
    /// `∂e/∂p` of the free parameters of all effects at one sample.
    columns: Vec<Vector3<f64>>,
    sums: [Sums; 2],
}

/// The sums for one vector.
#[derive(Clone, Debug, Default)]
struct Sums {
    /// `Σ h (x − b)ᵀ`.
    reading: Matrix3<f64>,
    /// `Σ h`.
    target: Vector3<f64>,
    /// `Σ hᵀ ∂e/∂p` of the free parameters of all effects.
    effects: Vec<f64>,
}

/// An effect, its parameters as constants, and which of them are free.
struct Active<'a> {
    effect: &'a EffectRef,
    p: Vec<Jet>,
    lanes: Vec<Lane>,
}

/// Variable of a derivative.
#[derive(Clone, Copy, Debug)]
enum Lane {
    Signal(usize),
    Parameter(usize),
}

impl<'a> Sensitivity<'a> {
    /// At the parameters `x` of `model`, by those listed in `free`.
    pub fn new(model: &'a Model, x: &[f64], free: &'a [usize]) -> Self {
        let mut from = BASE_PARAMETERS;
        let mut effects = Vec::new();
        let mut count = 0;
        for effect in model.effects() {
            let all = from..from + effect.params().len();
            let signal = (0..3).filter(|_| !effect.is_linear()).map(Lane::Signal);
            let wanted = free.iter().filter(|k| all.contains(k));
            let parameters: Vec<Lane> = wanted.map(|k| Lane::Parameter(k - from)).collect();
            count += parameters.len();
            effects.push(Active {
                effect,
                p: x[all.clone()].iter().map(|&v| lit(v)).collect(),
                lanes: signal.chain(parameters).collect(),
            });
            from = all.end;
        }
        let sums = Sums {
            effects: vec![0.0; count],
            ..Sums::default()
        };
        Self {
            base: Base::from_parameters(x),
            effects,
            free,
            columns: Vec::with_capacity(count),
            sums: [sums.clone(), sums],
        }
    }

    /// Adds the sample `reading` with its signal, what else is `known` of it, and its two vectors.
    pub fn add(
        &mut self,
        reading: &Vector3<f64>,
        signal: &Vector3<f64>,
        known: &Kinematics<f64>,
        vectors: &[Vector3<f64>; 2],
    ) {
        let known = known.with_signal(Sensor::Gyroscope, *signal);
        let mut by_signal = Matrix3::identity();
        self.columns.clear();
        for active in &mut self.effects {
            active.differentiate(&known, &mut by_signal, &mut self.columns);
        }
        let inverse = inverse(&by_signal).unwrap_or_else(Matrix3::identity);
        let unbiased = reading - self.base.bias;
        for (sums, vector) in self.sums.iter_mut().zip(vectors) {
            let h = inverse.tr_mul(vector);
            sums.reading += h * unbiased.transpose();
            sums.target += h;
            for (sum, column) in sums.effects.iter_mut().zip(&self.columns) {
                *sum += h.dot(column);
            }
        }
    }

    /// The two sums for each free parameter.
    pub fn gradients(&self) -> [Vec<f64>; 2] {
        self.sums.each_ref().map(|sums| {
            let bias = self.base.t.tr_mul(&sums.target);
            let mut effects = sums.effects.iter();
            let slope = |&k: &usize| match PLACES.get(k) {
                Some(place) => sums.reading[*place],
                None if k < BASE_PARAMETERS => -bias[k - PLACES.len()],
                None => effects.next().map_or(0.0, |sum| -sum),
            };
            self.free.iter().map(slope).collect()
        })
    }
}

impl Active<'_> {
    /// Adds `∂e/∂s` to `by_signal` and appends the columns of `∂e/∂p`.
    fn differentiate(
        &mut self,
        known: &Kinematics<f64>,
        by_signal: &mut Matrix3<f64>,
        columns: &mut Vec<Vector3<f64>>,
    ) {
        for lanes in self.lanes.chunks(LANES) {
            let mut truth: Kinematics<Jet> = known.lift();
            for (n, lane) in lanes.iter().enumerate() {
                match *lane {
                    Lane::Signal(i) => truth.angular_rate[i] = variable(known.angular_rate[i], n),
                    Lane::Parameter(k) => self.p[k] = variable(self.p[k].re, n),
                }
            }
            let error = self.effect.error_jet(&truth, &self.p);
            let slopes = error.map(|v| derivatives(&v));
            for (n, lane) in lanes.iter().enumerate() {
                let column = Vector3::from_fn(|i, _| slopes[i][n]);
                match *lane {
                    Lane::Signal(i) => {
                        let sum = by_signal.column(i) + column;
                        by_signal.set_column(i, &sum);
                    }
                    Lane::Parameter(k) => {
                        columns.push(column);
                        self.p[k] = lit(self.p[k].re);
                    }
                }
            }
        }
    }
}
