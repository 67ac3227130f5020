//! The effects of a model with their derivatives, by forward mode, a few columns of one effect per pass.

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, EffectRef, Kinematics, Model, Sensor};
use solver::scalar::{derivatives, variable};
use solver::{Jet, lit};

use super::by_parameters::ByParameters;

/// The sum of the effects of a model at one instant.
#[derive(Clone, Copy, Debug)]
pub struct EffectSlopes {
    /// `e`, in the unit of the sensor's signal (3).
    pub value: Vector3<f64>,
    /// `∂e/∂s` by a signal of the truth (3 × 3).
    pub by_signal: Matrix3<f64>,
}

/// A model's effects at its parameters, for many instants.
pub struct ModelSlopes<'a> {
    effects: Vec<OfEffect<'a>>,
    by: Sensor,
}

struct OfEffect<'a> {
    effect: &'a EffectRef,
    p: &'a [f64],
    /// `p` without derivatives; `None` of an effect whose error does not depend on the signal.
    constants: Option<Vec<Jet>>,
    by_parameters: ByParameters<'a>,
}

impl<'a> ModelSlopes<'a> {
    /// With the model's parameters `p`, by the signal that `by` measures.
    pub fn new(model: &'a Model, p: &'a [f64], by: Sensor) -> Self {
        let mut from = BASE_PARAMETERS;
        let own = |effect: &'a EffectRef| {
            let own = &p[from..from + effect.params().len()];
            from += own.len();
            let all: Vec<usize> = (0..own.len()).collect();
            let is_apart = effect.is_linear() && effect.sensor() == by;
            OfEffect {
                effect,
                p: own,
                constants: (!is_apart).then(|| own.iter().map(|&v| lit(v)).collect()),
                by_parameters: ByParameters::new(effect, own, &all),
            }
        };
        Self {
            effects: model.effects().iter().map(own).collect(),
            by,
        }
    }

    /// Returns true if no effect depends on the signal.
    pub fn is_apart_from_signal(&self) -> bool {
        let mut all = self.effects.iter();
        all.all(|own| own.constants.is_none())
    }

    /// The sum of the effects at `truth`; pushes `∂e/∂p` by each of their parameters.
    pub fn at(
        &self,
        truth: &Kinematics<f64>,
        by_parameters: &mut Vec<Vector3<f64>>,
    ) -> EffectSlopes {
        let mut all = EffectSlopes {
            value: Vector3::zeros(),
            by_signal: Matrix3::zeros(),
        };
        for own in &self.effects {
            match &own.constants {
                None => all.value += own.effect.error_f64(truth, own.p),
                Some(constants) => {
                    let signal = truth.signal(self.by);
                    let lanes = Vector3::from_fn(|i, _| variable(signal[i], i));
                    let truth = truth.lift::<Jet>().with_signal(self.by, lanes);
                    let error = own.effect.error_jet(&truth, constants);
                    all.value += error.map(|v| v.re);
                    all.by_signal += Matrix3::from_fn(|i, j| derivatives(&error[i])[j]);
                }
            }
            own.by_parameters.at(truth, by_parameters);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::joint::rows::by_parameters::ByParameters;

    impl<'a> ModelSlopes<'a> {
        /// By the gyroscope's signal, with no effect taken for linear.
        fn by_jets(model: &'a Model, p: &'a [f64]) -> Self {
            let mut all = Self::new(model, p, Sensor::Gyroscope);
            for own in &mut all.effects {
                own.constants = Some(own.p.iter().map(|&v| lit(v)).collect());
                own.by_parameters = ByParameters::by_jets(own.effect, own.p);
            }
            all
        }
    }

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
        let all = effects::catalogue_of(Sensor::Gyroscope);
        let linear: Vec<_> = all.filter(|effect| effect.is_linear()).collect();
        assert!(linear.len() > 5);
        for effect in linear {
            let model = Model::base(Sensor::Gyroscope).with(effect.clone());
            let mut p = model.parameters().values().to_vec();
            for (k, value) in p.iter_mut().enumerate().skip(BASE_PARAMETERS) {
                *value = 1e-3 * (k as f64).sin();
            }
            let apart = ModelSlopes::new(&model, &p, Sensor::Gyroscope);
            let jets = ModelSlopes::by_jets(&model, &p);
            assert!(apart.is_apart_from_signal() && !jets.is_apart_from_signal());
            let [(found, columns), (by_jets, derivatives)] = [apart, jets].map(|slopes| {
                let mut by_parameters = Vec::new();
                (slopes.at(&truth, &mut by_parameters), by_parameters)
            });
            assert_eq!(found.value, by_jets.value, "{}", effect.name());
            assert_eq!(found.by_signal, by_jets.by_signal, "{}", effect.name());
            for (column, derivative) in columns.iter().zip(&derivatives) {
                let off = (column - derivative).norm();
                assert!(off <= 1e-15 * derivative.norm(), "{}", effect.name());
            }
        }
    }
}
