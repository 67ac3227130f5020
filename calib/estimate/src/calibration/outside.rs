//! Effects of other crates.

use sensor::EffectRef;

/// A compiled effect that is in no catalogue of this program. Two are the same where their names are.
#[derive(Clone, Debug)]
pub struct Outside(pub EffectRef);

impl PartialEq for Outside {
    fn eq(&self, other: &Self) -> bool {
        self.0.name() == other.0.name()
    }
}
