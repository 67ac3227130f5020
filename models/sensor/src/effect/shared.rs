//! An effect that a model, a request and a result share.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use super::{AnyEffect, Effect};

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
    /// Returns true if both are the same object.
    pub fn is(&self, other: &Self) -> bool {
        std::ptr::addr_eq(&raw const **self, &raw const **other) && self.name() == other.name()
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

impl<E: Effect> From<&'static E> for EffectRef {
    fn from(effect: &'static E) -> Self {
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
