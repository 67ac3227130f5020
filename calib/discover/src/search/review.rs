//! A second look at every name, everything else that was named being in the model.

use effects::room_field;
use estimate::methods::joint::Known;
use recording::Error;
use sensor::Sensor;

use super::either::Either;
use super::held::Held;
use super::ranking::{Earth, as_the_earth};
use super::{Finder, MOST_NAMES, Name, Tie};
use crate::extension::with_companions;
use crate::family::{Claim, Family};
use crate::rank::{APART, Ranked, shared};
use crate::separation::Rivalry;
use crate::state::State;

/// A claim that explains no more than this share of what the named one does is another matter, and no tie.
const OF_THE_SAME: f64 = 0.2;

/// The field of a room, where a rotation has no vertical part to tell the two apart.
fn as_a_room(family: &Family, named: &Ranked) -> Option<Tie> {
    let is_either = matches!(as_the_earth(family, named), Earth::OrARoom);
    let field = room_field(Sensor::Gyroscope).filter(|_| is_either)?;
    Some(Tie {
        claim: Claim::Effect(field),
        behind: 0.0,
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
    /// True if the review stopped because its budget of fits was spent.
    pub is_spent: bool,
}

enum Verdict {
    Stays(Ranked),
    Gone,
    Other(Held),
}

impl Finder<'_> {
    /// Each name against all others once more, everything else named being in the model: names that are no
    /// longer evident go, and a name makes way for one that is more evident.
    pub(super) fn review(
        &self,
        base: &State,
        last: State,
        mut held: Vec<Held>,
    ) -> Result<Reviewed, Error> {
        let (mut last, mut is_spent) = (last, false);
        if held.len() == 2 && self.try_pairs(base, &mut held) {
            last = self.state(&held)?;
        }
        for _ in 0..2 * MOST_NAMES {
            let certain = self.certain(&last);
            let mut names = Vec::new();
            let mut changed = false;
            for k in 0..held.len() {
                if certain.iter().any(|(known, _)| held[k].is(known)) {
                    continue;
                }
                let own = held[k].clone();
                let without = self.without(base, &held, k)?;
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
                let found: f64 = held.iter().map(|h| h.evidence).sum();
                let beside: f64 = certain.iter().map(|(_, evidence)| evidence).sum();
                let beside = names.iter().map(|n| n.ranked.by_ratio()).sum::<f64>() + beside;
                return Ok(Reviewed {
                    either: self.either(base, &held, &names, &certain)?,
                    names,
                    evidence: found.max(beside),
                    last,
                    is_spent: false,
                });
            }
            // The model after this change, and each of its names once more.
            if self.is_spent(held.len() + 1) && !held.is_empty() {
                is_spent = true;
                break;
            }
            last = if held.is_empty() {
                base.clone()
            } else {
                self.state(&held)?
            };
        }
        Ok(Reviewed {
            names: Vec::new(),
            either: Vec::new(),
            evidence: 0.0,
            last: base.clone(),
            is_spent,
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
        certain.retain(|(_, evidence)| *evidence > self.threshold + APART);
        certain
    }

    fn judge(&self, own: &Held, families: &[Family], ranked: &[Ranked]) -> Verdict {
        let Some(mine) = own.found(families, ranked) else {
            return Verdict::Gone;
        };
        let Some(top) = ranked.first() else {
            return Verdict::Gone;
        };
        if top.evidence > mine.evidence + APART && !self.is_simpler(families, top, mine) {
            return Verdict::Other(Held::of(families, top));
        }
        if mine.evidence <= own.claim.needed(self.threshold) {
            return Verdict::Gone;
        }
        let found = &families[mine.family].hypotheses[mine.hypothesis];
        if found.shape != own.hypothesis.shape {
            return Verdict::Other(Held::of(families, mine));
        }
        Verdict::Stays(mine.clone())
    }

    /// The claims whose evidence is within 20 to 1 of the named one's, and that explain some of the same.
    pub(super) fn ties(
        &self,
        state: &State,
        families: &[Family],
        ranked: &[Ranked],
        named: &Ranked,
    ) -> Vec<Tie> {
        ranked
            .iter()
            .filter(|r| r.family != named.family && r.evidence > named.evidence - APART)
            .map(|r| Tie {
                claim: families[r.family].claim.clone(),
                behind: named.evidence - r.evidence,
                shared: shared(&state.projected, families, named, r).unwrap_or(0.0),
                rivalry: Rivalry::of(state, families, (named, r), self.catalogue),
            })
            .filter(|tie| tie.shared > OF_THE_SAME)
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
}
