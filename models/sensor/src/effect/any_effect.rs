//! An effect behind a pointer.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use nalgebra::Vector3;
use solver::{Jet, Jet2, Scalar};

use crate::axis::Axis;
use crate::definition::{Definition, EffectFault};
use crate::kinematics::{Kinematics, Sensor};
use crate::param::{Param, Role};
use crate::quantity::Quantity;

/// Nature of an effect, for code that treats some effects differently.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Nature {
    /// An error of the sensor.
    #[default]
    SensorError,
    /// Samples are older than their stamps say. The effect is that to first order; a simulator reads the motion earlier
    /// instead.
    Delay,
    /// The rotation of the earth, which a gyroscope rightly measures: corrected readings keep it, and a latitude gives it.
    EarthRotation,
}

/// An [`Effect`](super::Effect) behind a pointer; derived for every effect.
pub trait AnyEffect: Send + Sync {
    /// Unique name in snake case.
    fn name(&self) -> &str;
    /// The sensor that has it.
    fn sensor(&self) -> Sensor;
    /// The equation as users read it.
    fn equation(&self) -> String;
    /// The error on an axis as an expression, where there is one.
    fn formula(&self, axis: Axis) -> Option<String> {
        let _ = axis;
        None
    }
    /// Names, units and nominal values.
    fn params(&self) -> &[Param];
    /// Size of a coefficient in a consumer-grade device.
    fn typical(&self) -> f64;
    /// Returns true if the error is `F p` with an `F` that does not depend on the sensor's own signal.
    fn is_linear(&self) -> bool {
        false
    }
    /// Returns the quantities that the effect depends on.
    fn needs(&self) -> Vec<Quantity>;
    /// Returns the nature of the effect.
    fn nature(&self) -> Nature {
        Nature::SensorError
    }
    /// The effect of lower order that comes with it.
    fn companion(&self) -> Option<&'static str> {
        None
    }
    /// Returns true if no sensor has negative coefficients.
    fn is_positive(&self) -> bool {
        false
    }
    /// The coefficient that is nothing by convention.
    fn reference(&self) -> Option<&'static str> {
        None
    }
    /// Size of the parameter in place `k`: its own where it has one, otherwise that of the effect.
    fn typical_of(&self, k: usize) -> f64 {
        let own = self.params().get(k).and_then(|p| p.typical);
        own.unwrap_or_else(|| self.typical())
    }
    /// The place of the parameter that is an instant: such an effect belongs to the recording that it was found in.
    fn instant(&self) -> Option<usize> {
        let mut roles = self.params().iter().map(|p| p.role);
        roles.position(|role| role == Role::Instant)
    }
    /// The text that defines it; `None` for what is compiled.
    fn definition(&self) -> Option<&Definition> {
        None
    }
    /// The same effect with the steps that fits of `samples` readings may take, counted from here; `None` for what is compiled, which takes
    /// what it takes.
    fn granted(&self, samples: usize) -> Option<EffectRef> {
        let _ = samples;
        None
    }
    /// Its fault so far: steps that are spent, or an error that was no number.
    fn fault(&self) -> Option<EffectFault> {
        None
    }
    /// [`Effect::error`](crate::Effect::error) for values.
    fn error_f64(&self, truth: &Kinematics<f64>, p: &[f64]) -> Vector3<f64>;
    /// [`Effect::error`](crate::Effect::error) with first derivatives.
    fn error_jet(&self, truth: &Kinematics<Jet>, p: &[Jet]) -> Vector3<Jet>;
    /// [`Effect::error`](crate::Effect::error) with second derivatives.
    fn error_jet2(&self, truth: &Kinematics<Jet2>, p: &[Jet2]) -> Vector3<Jet2>;
}

impl fmt::Debug for dyn AnyEffect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An effect of a registry or of one's own; cloning it shares it.
///
/// # Examples
/// ```
/// use std::sync::Arc;
/// use stillpoint_sensor::{Definition, DefinedParam, Effect, EffectRef, Sensor};
///
/// let swirl = Definition {
///     name: "gyro_swirl".into(),
///     x: "k * fy * fz".into(),
///     parameters: vec![DefinedParam::new("k", "rad/s/(m/s^2)^2", 5e-6)],
///     ..Definition::silent(Sensor::Gyroscope)
/// };
/// let effect: EffectRef = swirl.effect()?;
/// assert_eq!((effect.name(), effect.clone().params().len()), ("gyro_swirl", 1));
/// # Ok::<(), stillpoint_sensor::DefinitionError>(())
/// ```
#[derive(Clone)]
pub struct EffectRef(Owner);

#[derive(Clone)]
enum Owner {
    Registry(&'static dyn AnyEffect),
    Shared(Arc<dyn AnyEffect>),
}

impl EffectRef {
    /// Returns true if both have the same definition, or are the same object where they have none.
    pub fn is(&self, other: &Self) -> bool {
        match (self.definition(), other.definition()) {
            (None, None) => {
                std::ptr::addr_eq(&raw const **self, &raw const **other)
                    && self.name() == other.name()
            }
            (own, of_other) => own == of_other,
        }
    }
}

impl Deref for EffectRef {
    type Target = dyn AnyEffect;

    fn deref(&self) -> &Self::Target {
        match &self.0 {
            Owner::Registry(effect) => *effect,
            Owner::Shared(effect) => effect.as_ref(),
        }
    }
}

impl From<&'static dyn AnyEffect> for EffectRef {
    fn from(effect: &'static dyn AnyEffect) -> Self {
        Self(Owner::Registry(effect))
    }
}

impl From<Arc<dyn AnyEffect>> for EffectRef {
    fn from(effect: Arc<dyn AnyEffect>) -> Self {
        Self(Owner::Shared(effect))
    }
}

impl fmt::Debug for EffectRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The scalars that pass through an effect behind a pointer: `f64`, [`Jet`] and [`Jet2`].
///
/// Models and residuals are generic over this; an effect author never meets it.
pub trait ModelScalar: Scalar {
    /// Order of the highest derivative it carries.
    const ORDER: usize;

    /// [`Effect::error`](crate::Effect::error) of a pointed-to effect.
    fn error(effect: &dyn AnyEffect, truth: &Kinematics<Self>, p: &[Self]) -> Vector3<Self>;
}

impl ModelScalar for f64 {
    const ORDER: usize = 0;

    fn error(effect: &dyn AnyEffect, truth: &Kinematics<f64>, p: &[f64]) -> Vector3<f64> {
        effect.error_f64(truth, p)
    }
}

impl ModelScalar for Jet {
    const ORDER: usize = 1;

    fn error(effect: &dyn AnyEffect, truth: &Kinematics<Jet>, p: &[Jet]) -> Vector3<Jet> {
        effect.error_jet(truth, p)
    }
}

impl ModelScalar for Jet2 {
    const ORDER: usize = 2;

    fn error(effect: &dyn AnyEffect, truth: &Kinematics<Jet2>, p: &[Jet2]) -> Vector3<Jet2> {
        effect.error_jet2(truth, p)
    }
}
