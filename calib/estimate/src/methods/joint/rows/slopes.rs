//! The effects of a model with their derivatives, by forward mode, a few columns of one effect per pass.

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Kinematics, Model, Sensor};
use solver::scalar::{derivatives, variable};
use solver::{Jet, LANES, lit};

/// The sum of the effects of a model at one instant.
#[derive(Clone, Debug)]
pub struct EffectSlopes {
    /// `e`, in the unit of the sensor's signal (3).
    pub value: Vector3<f64>,
    /// `∂e/∂s` by a signal of the truth (3 × 3).
    pub by_signal: Matrix3<f64>,
    /// `∂e/∂p` by each parameter of the effects.
    pub by_parameters: Vec<Vector3<f64>>,
}

impl EffectSlopes {
    /// At `truth` with the model's parameters `p`, by the signal that `by` measures.
    pub fn at(model: &Model, truth: &Kinematics<f64>, p: &[f64], by: Sensor) -> Self {
        let own = p.len() - BASE_PARAMETERS;
        if own == 0 {
            return Self {
                value: Vector3::zeros(),
                by_signal: Matrix3::zeros(),
                by_parameters: Vec::new(),
            };
        }
        let mut constants: Vec<Jet> = p.iter().map(|&v| lit(v)).collect();
        let signal = truth.signal(by);
        let truth = truth.lift::<Jet>();
        let lanes = Vector3::from_fn(|i, _| variable(signal[i], i));
        let error = model.error(&truth.with_signal(by, lanes), &constants);
        let by_signal = Matrix3::from_fn(|i, j| derivatives(&error[i])[j]);
        let mut by_parameters = Vec::with_capacity(own);
        let mut from = BASE_PARAMETERS;
        for effect in model.effects() {
            let to = from + effect.params().len();
            for first in (from..to).step_by(LANES) {
                let lanes = first..to.min(first + LANES);
                for (lane, place) in lanes.clone().enumerate() {
                    constants[place] = variable(p[place], lane);
                }
                let error = effect.error_jet(&truth, &constants[from..to]);
                for (lane, place) in lanes.enumerate() {
                    by_parameters.push(error.map(|v| derivatives(&v)[lane]));
                    constants[place] = lit(p[place]);
                }
            }
            from = to;
        }
        Self {
            value: error.map(|v| v.re),
            by_signal,
            by_parameters,
        }
    }
}
