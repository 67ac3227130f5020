//! A name that the model holds.

use estimate::methods::joint::Known;

use crate::family::{Claim, Hypothesis};

/// A claim in the model, with the way in which it holds.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub claim: Claim,
    pub hypothesis: Hypothesis,
    /// When it was found.
    pub evidence: f64,
}

impl Held {
    /// Whether this is a known disturbance.
    pub fn is(&self, known: &Known) -> bool {
        matches!(self.claim, Claim::Disturbed(kind) if kind == known.kind)
            && self.hypothesis.place == Some(known.place)
    }
}
