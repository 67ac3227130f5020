//! A name that the model holds.

use estimate::methods::joint::Known;

use crate::family::{Claim, Family, Hypothesis};
use crate::rank::Ranked;

/// A claim in the model, with the way in which it holds.
#[derive(Clone, Debug)]
pub(super) struct NamedClaim {
    pub claim: Claim,
    pub hypothesis: Hypothesis,
    /// When it was found, by the likelihood ratio.
    pub evidence: f64,
}

impl NamedClaim {
    /// The best of a family's hypotheses.
    pub fn of(families: &[Family], ranked: &Ranked) -> Self {
        let family = &families[ranked.family];
        Self {
            claim: family.claim.clone(),
            hypothesis: family.hypotheses[ranked.hypothesis].clone(),
            evidence: ranked.by_ratio(),
        }
    }

    /// Returns true if this is the given disturbance.
    pub fn is(&self, known: &Known) -> bool {
        let own = self.claim.known(&self.hypothesis);
        own.is_some_and(|own| own.is_at(known))
    }

    /// Finds this claim in a ranking; a local claim only if its best place is this one.
    pub fn found<'r>(&self, families: &[Family], ranked: &'r [Ranked]) -> Option<&'r Ranked> {
        ranked.iter().find(|r| {
            let family = &families[r.family];
            let place = self.hypothesis.place;
            family.claim.is_same(&self.claim)
                && (place.is_none() || family.hypotheses[r.hypothesis].place == place)
        })
    }
}
