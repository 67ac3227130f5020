//! Whether a device crept or its rate was off, or was pushed or a turn is bad: what a fit cannot tell apart is said together.

use estimate::methods::joint::{Disturbance, Known};
use recording::Error;

use super::either::Either;
use super::held::Held;
use super::{Finder, Name, Tie};
use crate::family::Claim;
use crate::state::State;

impl Finder<'_> {
    /// What the disturbances that are held cannot be told from: of those with a name by its ties, of rests that are beyond
    /// doubt by one more fit without each. A creep about the vertical does to the readings of a rest what a rate does that
    /// is off, and a push across gravity what a turn does that lost samples.
    pub(super) fn either(
        &self,
        base: &State,
        held: &[Held],
        names: &[Name],
        certain: &[(Known, f64)],
    ) -> Result<Vec<Either>, Error> {
        let mut all = Vec::new();
        for name in names {
            if let (Claim::Disturbed(kind), Some(place)) = (name.claim, name.hypothesis.place) {
                all.extend(Either::of(Known { kind, place }, names_of(&name.ties)));
            }
        }
        for (known, _) in certain {
            let k = held.iter().position(|h| h.is(known));
            let of_a_rest = matches!(
                known.kind,
                Disturbance::MountSlip
                    | Disturbance::RateExcursion
                    | Disturbance::DisturbedInterval
            );
            let (Some(k), true, false) = (k, of_a_rest, self.is_spent(1)) else {
                continue;
            };
            let without = self.without(base, held, k)?;
            let ranking = self.ranked(&without);
            let (families, ranked) = (&ranking.families, &ranking.ranked);
            let Some(own) = held[k].found(families, ranked) else {
                continue;
            };
            let mut ties = self.ties(&without, families, ranked, own);
            ties.retain(|tie| matches!(tie.claim, Claim::Disturbed(_)));
            all.extend(Either::of(*known, names_of(&ties)));
        }
        Ok(all)
    }

    /// The model with all that is held but one.
    pub(super) fn without(&self, base: &State, held: &[Held], k: usize) -> Result<State, Error> {
        let mut others = held.to_vec();
        others.remove(k);
        if others.is_empty() {
            Ok(base.clone())
        } else {
            self.state(&others)
        }
    }
}

fn names_of(ties: &[Tie]) -> impl Iterator<Item = &'static str> {
    ties.iter().map(|tie| tie.claim.name())
}
