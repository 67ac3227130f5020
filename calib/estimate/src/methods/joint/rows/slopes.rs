//! The effects of a model with their derivatives, by forward mode, a few columns of one effect per pass.

use nalgebra::{Matrix3, Vector3};
use sensor::{AnyEffect, BASE_PARAMETERS, Kinematics, Model, Sensor};
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
        let mut all = Self {
            value: Vector3::zeros(),
            by_signal: Matrix3::zeros(),
            by_parameters: Vec::with_capacity(p.len() - BASE_PARAMETERS),
        };
        let mut from = BASE_PARAMETERS;
        for &effect in model.effects() {
            let to = from + effect.params().len();
            if effect.is_linear() && effect.sensor() == by {
                all.add_linear(effect, truth, &p[from..to]);
            } else {
                all.add(effect, truth, &p[from..to], by);
            }
            from = to;
        }
        all
    }

    /// Adds an effect by forward mode.
    fn add(&mut self, effect: &dyn AnyEffect, truth: &Kinematics<f64>, p: &[f64], by: Sensor) {
        let mut constants: Vec<Jet> = p.iter().map(|&v| lit(v)).collect();
        let signal = truth.signal(by);
        let truth = truth.lift::<Jet>();
        let lanes = Vector3::from_fn(|i, _| variable(signal[i], i));
        let error = effect.error_jet(&truth.with_signal(by, lanes), &constants);
        self.value += error.map(|v| v.re);
        self.by_signal += Matrix3::from_fn(|i, j| derivatives(&error[i])[j]);
        for first in (0..p.len()).step_by(LANES) {
            let lanes = first..p.len().min(first + LANES);
            for (lane, place) in lanes.clone().enumerate() {
                constants[place] = variable(p[place], lane);
            }
            let error = effect.error_jet(&truth, &constants);
            for (lane, place) in lanes.enumerate() {
                self.by_parameters
                    .push(error.map(|v| derivatives(&v)[lane]));
                constants[place] = lit(p[place]);
            }
        }
    }

    /// Adds an effect `F p` whose `F` does not depend on the signal: its columns are the errors of unit parameters.
    fn add_linear(&mut self, effect: &dyn AnyEffect, truth: &Kinematics<f64>, p: &[f64]) {
        self.value += effect.error_f64(truth, p);
        let mut unit = vec![0.0; p.len()];
        for place in 0..p.len() {
            unit[place] = 1.0;
            self.by_parameters.push(effect.error_f64(truth, &unit));
            unit[place] = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_linear_effects_are_their_derivatives() {
        let truth = Kinematics {
            specific_force: Vector3::new(3.0, -5.0, 7.0),
            angular_rate: Vector3::new(0.3, 1.1, -0.7),
            time: 12.0,
            temperature: 31.0,
            temperature_rate: 0.02,
            warming: 1.0,
            last_change: Vector3::new(1.0, -1.0, 1.0),
            vibration: Vector3::new(0.1, 0.2, 0.3),
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let all = gyroscope::EFFECTS.iter().copied();
        let linear: Vec<_> = all.filter(|effect| effect.is_linear()).collect();
        assert!(linear.len() > 5);
        for effect in linear {
            let model = Model::base(Sensor::Gyroscope).with(effect);
            let mut p = model.parameters().values().to_vec();
            for (k, value) in p.iter_mut().enumerate().skip(BASE_PARAMETERS) {
                *value = 1e-3 * (k as f64).sin();
            }
            let found = EffectSlopes::at(&model, &truth, &p, Sensor::Gyroscope);
            let mut by_jets = EffectSlopes {
                value: Vector3::zeros(),
                by_signal: Matrix3::zeros(),
                by_parameters: Vec::new(),
            };
            let own = &p[BASE_PARAMETERS..];
            by_jets.add(effect, &truth, own, Sensor::Gyroscope);
            assert_eq!(found.value, by_jets.value, "{}", effect.name());
            assert_eq!(found.by_signal, by_jets.by_signal, "{}", effect.name());
            let pairs = found.by_parameters.iter().zip(&by_jets.by_parameters);
            for (column, derivative) in pairs {
                let off = (column - derivative).norm();
                assert!(off <= 1e-15 * derivative.norm(), "{}", effect.name());
            }
        }
    }
}
