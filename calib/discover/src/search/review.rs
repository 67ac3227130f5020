//! A second look at every name, everything else that was named being in the model.

use effects::room_field;
use estimate::methods::joint::{Data, Known, Scope};
use recording::Error;
use sensor::Sensor;

use super::all_together::evidence_together;
use super::named_claim::NamedClaim;
use super::names::{Either, Name, Tie};
use super::ranking::{Earth, as_the_earth};
use super::{Finder, MOST_NAMES};
use crate::family::{Claim, Family};
use crate::rank::{APART, Ranked, shared};
use crate::separation::Rivalry;
use crate::state::{State, with_companions};

findings::tuning! {
    /// A claim that explains no more than this share of what the named one does is another matter, and no tie.
    OF_THE_SAME: f64 = 0.2;
}

/// The field of a room, where a rotation has no vertical part to tell the two apart.
fn as_a_room(family: &Family, named: &Ranked) -> Option<Tie> {
    let is_either = matches!(as_the_earth(family, named), Earth::OrARoom);
    let field = room_field(Sensor::Gyroscope).filter(|_| is_either)?;
    Some(Tie {
        claim: Claim::Effect(field),
        shared: 1.0,
        rivalry: None,
    })
}

/// Names that remain after the review.
pub(super) struct Reviewed {
    pub names: Vec<Name>,
    pub either: Vec<Either>,
    pub evidence: f64,
    pub last: State,
    /// True if the review came to no end: its budget of fits was spent, or two names made way for each other.
    pub is_spent: bool,
}

enum Verdict {
    Stays(Ranked),
    Gone,
    Other(NamedClaim),
}

impl Finder<'_> {
    /// Each name against all others once more, everything else named being in the model: names that are no
    /// longer evident go, and a name makes way for one that is more evident.
    pub(super) fn review(
        &self,
        mut last: State,
        mut held: Vec<NamedClaim>,
    ) -> Result<Reviewed, Error> {
        if held.len() == 2 && self.try_pairs(&mut held) {
            last = self.state(&held)?;
        }
        for _ in 0..2 * MOST_NAMES.get() {
            let certain = self.certain(&last);
            let mut names = Vec::new();
            let mut changed = false;
            for k in 0..held.len() {
                if certain.iter().any(|(known, _)| held[k].is(known)) {
                    continue;
                }
                let own = held[k].clone();
                let without = self.without(&held, k)?;
                let ranking = self.ranked(&without);
                let (families, ranked) = (&ranking.families, &ranking.ranked);
                match self.judge(&own, families, ranked) {
                    Verdict::Gone => {
                        held.remove(k);
                        changed = true;
                    }
                    Verdict::Other(better) => {
                        held[k] = better;
                        changed = true;
                    }
                    Verdict::Stays(own) => {
                        let ties = self.ties(&without, families, ranked, &own);
                        names.push(Name::of(families, &own, without, ties));
                    }
                }
                if changed {
                    break;
                }
            }
            if !changed {
                names.sort_by(|a, b| b.ranked.evidence.total_cmp(&a.ranked.evidence));
                let together = evidence_together(&self.base, &held, self.catalogue);
                let found = || held.iter().map(|h| h.evidence).sum();
                return Ok(Reviewed {
                    either: self.either(&held, &names, &certain)?,
                    names,
                    evidence: together.unwrap_or_else(found),
                    last,
                    is_spent: false,
                });
            }
            // The model after this change, and each of its names once more.
            if self.is_spent(held.len() + 1) && !held.is_empty() {
                break;
            }
            last = self.state(&held)?;
        }
        Ok(Reviewed {
            names: Vec::new(),
            either: Vec::new(),
            evidence: 0.0,
            last: self.base.clone(),
            is_spent: true,
        })
    }

    /// The disturbances of a model that are beyond doubt by their own parameters, with their evidence.
    fn certain(&self, state: &State) -> Vec<(Known, f64)> {
        let places = state.fit.data.chunks.len() + state.fit.data.turns.len();
        let search = (places as f64).ln() + (2.0 * self.catalogue.len() as f64).ln();
        let mut certain = state.disturbances();
        for (_, evidence) in &mut certain {
            *evidence = -*evidence - search;
        }
        certain.retain(|(_, evidence)| *evidence > self.threshold + APART.get());
        certain
    }

    fn judge(&self, own: &NamedClaim, families: &[Family], ranked: &[Ranked]) -> Verdict {
        let Some(mine) = own.found(families, ranked) else {
            return Verdict::Gone;
        };
        let Some(top) = ranked.first() else {
            return Verdict::Gone;
        };
        if top.evidence > mine.evidence + APART.get() && !self.is_simpler(families, top, mine) {
            return Verdict::Other(NamedClaim::of(families, top));
        }
        if mine.evidence <= own.claim.needed(self.threshold) {
            return Verdict::Gone;
        }
        let found = &families[mine.family].hypotheses[mine.hypothesis];
        if found.shape != own.hypothesis.shape {
            return Verdict::Other(NamedClaim::of(families, mine));
        }
        Verdict::Stays(mine.clone())
    }

    /// The claims whose evidence is within 20 to 1 of the named one's, and that explain some of the same.
    fn ties(
        &self,
        state: &State,
        families: &[Family],
        ranked: &[Ranked],
        named: &Ranked,
    ) -> Vec<Tie> {
        ranked
            .iter()
            .filter(|r| r.family != named.family && r.evidence > named.evidence - APART.get())
            .map(|r| Tie {
                claim: families[r.family].claim.clone(),
                shared: shared(&state.projected, families, named, r).unwrap_or(0.0),
                rivalry: Rivalry::of(state, families, (named, r), self.catalogue),
            })
            .filter(|tie| tie.shared > OF_THE_SAME.get())
            .chain(as_a_room(&families[named.family], named))
            .collect()
    }

    /// Returns true if `one` is the first order of `top`.
    fn is_simpler(&self, families: &[Family], top: &Ranked, one: &Ranked) -> bool {
        match &families[top.family].claim {
            Claim::Effect(effect) => with_companions(effect, self.catalogue)
                .skip(1)
                .any(|c| c.name() == families[one.family].claim.name()),
            _ => false,
        }
    }

    /// Lists the alternatives to the disturbances in the model: from the ties of a named one, and by one more fit without
    /// it for a `certain` one of a static interval.
    ///
    /// A creep about the vertical has the same effect on the readings of a static interval as a rate excursion, and a push
    /// across gravity the same as a turn that lost samples.
    fn either(
        &self,
        held: &[NamedClaim],
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
            let mut ties = self.other_faults(held, k)?;
            let exchanged = across(&self.base.fit.data, held, k)
                .filter(|_| ties.is_empty() && !self.is_spent(1));
            if let Some(exchanged) = exchanged {
                ties = self.other_faults(&exchanged, k)?;
            }
            all.extend(Either::of(*known, names_of(&ties)));
        }
        Ok(all)
    }

    /// The disturbances that do to the data what the one at place `k` of those held does, beside the others.
    fn other_faults(&self, held: &[NamedClaim], k: usize) -> Result<Vec<Tie>, Error> {
        let without = self.without(held, k)?;
        let ranking = self.ranked(&without);
        let (families, ranked) = (&ranking.families, &ranking.ranked);
        let own = held[k].found(families, ranked);
        let ties = own.map(|own| self.ties(&without, families, ranked, own));
        let mut ties = ties.unwrap_or_default();
        ties.retain(|tie| matches!(tie.claim, Claim::Disturbed(_)));
        Ok(ties)
    }
}

/// The names held with the turn on the other side of the rest `k`, where a turn beside it is held as bad: a rest whose direction is
/// open makes both the same, and rounding decides which of them is found.
fn across(data: &Data, held: &[NamedClaim], k: usize) -> Option<Vec<NamedClaim>> {
    let place = held[k].hypothesis.place?;
    let rest = match held[k].claim {
        Claim::Disturbed(fault) => fault.scope.static_interval(data, place)?,
        _ => place,
    };
    let other_side = |h: &NamedClaim| {
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
