//! Disturbances that a fit cannot tell apart, such as creep and a rate excursion, or a push and an outlying turn.

use estimate::methods::joint::{Known, Scope};
use recording::Error;

use super::either::Either;
use super::held::Held;
use super::{Finder, Name, Tie};
use crate::family::Claim;
use crate::state::State;

impl Finder<'_> {
    /// Lists the alternatives to the disturbances in the model: from the ties of a named one, and by one more fit without
    /// it for a `certain` one of a static interval.
    ///
    /// A creep about the vertical has the same effect on the readings of a static interval as a rate excursion, and a push
    /// across gravity the same as a turn that lost samples.
    pub(super) fn either(
        &self,
        base: &State,
        held: &[Held],
        names: &[Name],
        certain: &[(Known, f64)],
    ) -> Result<Vec<Either>, Error> {
        let mut all = Vec::new();
        for name in names {
            if let (Claim::Disturbed(kind), Some(place)) = (&name.claim, name.hypothesis.place) {
                all.extend(Either::of(
                    Known::disturbed(kind, place),
                    names_of(&name.ties),
                ));
            }
        }
        for (known, _) in certain {
            let k = held.iter().position(|h| h.is(known));
            let of_a_rest = known.fault.is_over_with_interval;
            let (Some(k), true, false) = (k, of_a_rest, self.is_spent(1)) else {
                continue;
            };
            let mut ties = self.other_faults(base, held, k)?;
            let exchanged = across(base, held, k).filter(|_| ties.is_empty() && !self.is_spent(1));
            if let Some(exchanged) = exchanged {
                ties = self.other_faults(base, &exchanged, k)?;
            }
            all.extend(Either::of(*known, names_of(&ties)));
        }
        Ok(all)
    }

    /// The disturbances that do to the data what the one at place `k` of those held does, beside the others.
    fn other_faults(&self, base: &State, held: &[Held], k: usize) -> Result<Vec<Tie>, Error> {
        let without = self.without(base, held, k)?;
        let ranking = self.ranked(&without);
        let (families, ranked) = (&ranking.families, &ranking.ranked);
        let own = held[k].found(families, ranked);
        let ties = own.map(|own| self.ties(&without, families, ranked, own));
        let mut ties = ties.unwrap_or_default();
        ties.retain(|tie| matches!(tie.claim, Claim::Disturbed(_)));
        Ok(ties)
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

/// The same with the turn on the other side of the rest, where a turn beside it is held as bad: a rest whose direction is
/// open makes both the same, and rounding decides which of them is found.
fn across(base: &State, held: &[Held], k: usize) -> Option<Vec<Held>> {
    let data = &base.fit.data;
    let place = held[k].hypothesis.place?;
    let rest = match held[k].claim {
        Claim::Disturbed(fault) => fault.scope.static_interval(data, place)?,
        _ => place,
    };
    let other_side = |h: &Held| {
        if !matches!(h.claim, Claim::Disturbed(fault) if fault.scope == Scope::Turn) {
            return None;
        }
        let from = data.turns.get(h.hypothesis.place?)?.from;
        let from = match rest.checked_sub(from)? {
            0 => rest.checked_sub(1)?,
            1 => rest,
            _ => return None,
        };
        data.turns.iter().position(|turn| turn.from == from)
    };
    let turns = held.iter().map(other_side);
    let (j, turn) = turns.enumerate().find_map(|(j, turn)| Some((j, turn?)))?;
    let mut exchanged = held.to_vec();
    exchanged[j].hypothesis.place = Some(turn);
    Some(exchanged)
}

fn names_of(ties: &[Tie]) -> impl Iterator<Item = String> {
    ties.iter().map(|tie| tie.claim.name().to_owned())
}
