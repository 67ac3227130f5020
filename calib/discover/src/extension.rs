//! Terms that a model has beyond the base models.

use estimate::methods::joint::Known;
use sensor::EffectRef;

/// The parameter that shapes an effect (`tau`, `t0`), by its place, and its value, which the fit holds.
pub type Held = Option<(usize, f64)>;

/// Effects and disturbances of a model, on top of the base models.
#[derive(Clone, Debug, Default)]
pub struct Extension {
    /// Effects, with what shapes them.
    pub effects: Vec<(EffectRef, Held)>,
    /// Disturbances with their place: parameters of their own.
    pub disturbed: Vec<Known>,
    /// True if time constants are fitted, starting from their held values; false if they stay fixed.
    pub settles: bool,
}

impl Extension {
    /// Takes an effect in, with the companions of the `catalogue` that come with it.
    pub fn hold(&mut self, effect: EffectRef, shape: Held, catalogue: &[EffectRef]) {
        let companions: Vec<EffectRef> = with_companions(&effect, catalogue).skip(1).collect();
        self.effects.push((effect, shape));
        for companion in companions {
            let is_own = |(own, _): &(EffectRef, Held)| own.name() == companion.name();
            if !self.effects.iter().any(is_own) {
                self.effects.push((companion, None));
            }
        }
    }

    /// Returns true if both have the same terms, in any order.
    pub fn is_same(&self, other: &Self) -> bool {
        let holds = |(effect, held): &(EffectRef, Held)| {
            let mut others = other.effects.iter();
            others.any(|(e, h)| e.name() == effect.name() && h == held)
        };
        self.settles == other.settles
            && self.effects.len() == other.effects.len()
            && self.disturbed.len() == other.disturbed.len()
            && self.effects.iter().all(holds)
            && self
                .disturbed
                .iter()
                .all(|known| other.disturbed.contains(known))
    }
}

/// The effects that come with `effect`, itself first.
pub fn with_companions<'a>(
    effect: &EffectRef,
    catalogue: &'a [EffectRef],
) -> impl Iterator<Item = EffectRef> + use<'a> {
    let companion = effect.companion();
    let companion = companion.and_then(|with| catalogue.iter().find(|e| e.name() == with));
    std::iter::once(effect.clone()).chain(companion.cloned())
}
