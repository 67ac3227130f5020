//! Effects that the text of a spec cannot hold.

use std::fmt;

use sensor::{EffectRef, Sensor};

/// Effects of another crate, in the order in which they were added. They are told apart by their names.
#[derive(Clone, Default)]
pub struct OwnEffects(Vec<EffectRef>);

impl OwnEffects {
    /// These effects.
    ///
    /// ```
    /// use stillpoint_simulate::OwnEffects;
    ///
    /// assert_eq!(OwnEffects::new(&[]), OwnEffects::default());
    /// ```
    pub fn new(effects: &[EffectRef]) -> Self {
        Self(effects.to_vec())
    }

    /// Those of one sensor.
    pub(super) fn of(&self, sensor: Sensor) -> impl Iterator<Item = &EffectRef> {
        let all = self.0.iter();
        all.filter(move |effect| effect.sensor() == sensor)
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|effect| effect.name())
    }
}

impl PartialEq for OwnEffects {
    fn eq(&self, other: &Self) -> bool {
        self.names().eq(other.names())
    }
}

impl fmt::Debug for OwnEffects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}
