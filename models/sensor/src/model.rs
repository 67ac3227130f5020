//! A sensor: its base model and the effects it has.

use nalgebra::Vector3;
use solver::Parameters;

use crate::base::{BASE_PARAMETERS, Base, base_names};
use crate::effect::{EffectRef, ModelScalar};
use crate::kinematics::{Kinematics, Sensor};
use crate::param::Role;

/// A base model plus effects.
///
/// Its parameters are the twelve of the base, then those of each effect in turn.
#[derive(Clone, Debug)]
pub struct Model {
    sensor: Sensor,
    effects: Vec<EffectRef>,
}

impl Model {
    /// The base model alone.
    pub fn base(sensor: Sensor) -> Self {
        Self {
            sensor,
            effects: Vec::new(),
        }
    }

    /// The same model with one more effect.
    ///
    /// An effect of the other sensor is left out: it does not change this signal.
    #[must_use]
    pub fn with(mut self, effect: impl Into<EffectRef>) -> Self {
        let effect = effect.into();
        if effect.sensor() == self.sensor {
            self.effects.push(effect);
        }
        self
    }

    /// The sensor.
    pub fn sensor(&self) -> Sensor {
        self.sensor
    }

    /// The effects, in the order of their parameters.
    pub fn effects(&self) -> &[EffectRef] {
        &self.effects
    }

    /// Returns true if no effect depends on the sensor's own signal.
    pub fn is_apart_from_signal(&self) -> bool {
        self.effects.iter().all(|effect| effect.is_linear())
    }

    /// Names, units and nominal values of all parameters: `accel.s_x`, …, `gyro_g_sensitivity.xx`.
    pub fn parameters(&self) -> Parameters {
        let unit = self.sensor.unit();
        let mut parameters = Parameters::new();
        let nominal = Base::identity().parameters();
        for (k, name) in base_names(self.sensor).into_iter().enumerate() {
            parameters.push(name, if k < 9 { "" } else { unit }, nominal[k]);
        }
        for effect in &self.effects {
            for p in effect.params() {
                parameters.push(format!("{}.{}", effect.name(), p.name), &*p.unit, p.nominal);
            }
        }
        parameters
    }

    /// Returns the number of parameters.
    pub fn parameter_count(&self) -> usize {
        let own = self.effects.iter().map(|effect| effect.params().len());
        BASE_PARAMETERS + own.sum::<usize>()
    }

    /// The places of the parameters that depend on the heading of the level frame.
    pub fn references(&self) -> Vec<usize> {
        let roles = self.effects.iter().flat_map(|effect| effect.params());
        let places = roles.enumerate();
        let own = places.filter(|(_, param)| param.role == Role::Reference);
        own.map(|(k, _)| BASE_PARAMETERS + k).collect()
    }

    /// The sum of the effects at `truth`, in the unit of the signal.
    pub fn error<D: ModelScalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let mut sum = Vector3::from_element(D::from(0.0));
        let mut from = BASE_PARAMETERS;
        for effect in &self.effects {
            let to = from + effect.params().len();
            sum += D::error(&**effect, truth, &p[from..to]);
            from = to;
        }
        sum
    }

    /// The raw reading of `truth`: `T⁻¹ (signal + Σ effect(truth)) + b`; `None` where `T` is singular.
    pub fn distort<D: ModelScalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Option<Vector3<D>> {
        let signal = truth.signal(self.sensor) + self.error(truth, p);
        Base::from_parameters(p).distort(&signal)
    }
}
