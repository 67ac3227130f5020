//! Several units of one type: what they share, and how large it is in each.
//!
//! ```text
//! each unit: base models + its own faults ──► evidence of every effect ─┐ Fisher
//! unit 2 ...                                                           ─┼──► Σ ──► a name for all ──► refit of each ─┐
//!    ▲                                                                 ─┘                                           │
//!    └────────────────────────────────────────────────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! What a sensor lacks is a property of its type, how large it is one of the unit: calibrations, biases, noise and sizes are
//! those of each unit, only the evidence is added up.

mod agreement;
mod findings;
mod pool;
mod unit;

use std::borrow::Borrow;

use ::findings::{Finding, Kind};
use recording::{Error, Recording};
use sensor::EffectRef;

use crate::gap::channel::Channel;
use crate::gap::held_out::gap_of;
use crate::request::Request;
use agreement::agreement;
pub use findings::{
    Agreement, OwnEffect, SharedEffect, UNITS_SCHEMA, UnitAlone, UnitFindings, UnitSize,
};
use pool::{Pooled, pool};
use unit::Unit;

::findings::tuning! {
    /// Effects at most, shared ones and those of one unit together.
    MOST_EFFECTS: usize = 8;
}

/// An effect of some of the units, with what shapes it in each.
#[derive(Clone)]
struct EffectOfUnits {
    effect: EffectRef,
    /// One flag per unit: true if its model has the effect.
    units: Vec<bool>,
    is_shared: bool,
}

/// Finds what several units of one type lack, a recording of each.
///
/// # Errors
/// Fewer than two units; as [`discover`](crate::discover) for each.
pub fn discover_units<R: Borrow<Recording>>(
    recordings: &[R],
    request: &Request,
) -> Result<UnitFindings, Error> {
    if recordings.len() < 2 {
        return Err(Error::not_enough(Finding::of(Kind::ONE_UNIT_ONLY)));
    }
    let request = &request.granted(recordings);
    let each: Vec<[&Recording; 1]> = recordings.iter().map(|r| [r.borrow()]).collect();
    let units = each.iter().map(|recording| Unit::new(recording, request));
    let mut units = units.collect::<Result<Vec<Unit<'_>>, Error>>()?;
    let together = Together {
        request,
        candidates: request.candidates(),
    };
    let mut held = together.search(&mut units)?;
    together.review(&mut units, &mut held)?;
    together.written(&units, &held)
}

struct Together<'a> {
    request: &'a Request,
    candidates: Vec<EffectRef>,
}

impl Together<'_> {
    fn search(&self, units: &mut [Unit<'_>]) -> Result<Vec<EffectOfUnits>, Error> {
        let mut held: Vec<EffectOfUnits> = Vec::new();
        let mut passed: Vec<String> = Vec::new();
        while held.len() < MOST_EFFECTS.get() {
            let pooled = pool(units, &self.candidates, self.request.threshold(), &[]);
            let may = |p: &&Pooled| {
                let is_in = |h: &EffectOfUnits| h.effect.name() == p.effect.name();
                !passed.iter().any(|name| name == p.effect.name()) && !held.iter().any(is_in)
            };
            let Some(top) = pooled.iter().find(may) else {
                break;
            };
            let wanted = match self.wanted(top) {
                Some(wanted) => wanted,
                None if top.evidence > self.request.threshold() => {
                    passed.push(top.effect.name().to_owned());
                    continue;
                }
                None => break,
            };
            let own = self.take_in(units, top, &wanted)?;
            if own.iter().any(|is_in| *is_in) {
                let is_shared = own.iter().filter(|is_in| **is_in).count() > 1;
                held.push(EffectOfUnits {
                    effect: top.effect.clone(),
                    units: own,
                    is_shared,
                });
            } else {
                passed.push(top.effect.name().to_owned());
            }
        }
        Ok(held)
    }

    /// The units that are to have an effect: all that can show it where the others bear the most telling one out, else that
    /// one alone where it is evident there; `None` where nothing is evident.
    fn wanted(&self, top: &Pooled) -> Option<Vec<bool>> {
        if top.evidence > self.request.threshold() && top.is_shared(self.request.alpha) {
            return Some(top.units.iter().map(Option::is_some).collect());
        }
        let strongest = top.strongest()?;
        let evident = top.units[strongest].as_ref()?.evidence > self.request.threshold();
        evident.then(|| (0..top.units.len()).map(|k| k == strongest).collect())
    }

    /// Puts an effect into the models of the `wanted` units; the units that determine it.
    fn take_in(
        &self,
        units: &mut [Unit<'_>],
        top: &Pooled,
        wanted: &[bool],
    ) -> Result<Vec<bool>, Error> {
        let mut own = vec![false; units.len()];
        for (k, unit) in units.iter_mut().enumerate() {
            let says = top.units[k].as_ref().filter(|_| wanted[k]);
            if let Some(says) = says {
                own[k] = unit.take_in(top.effect.clone(), says.shape, &self.candidates)?;
            }
        }
        Ok(own)
    }

    /// Every effect once more beside all others: what is no longer evident goes.
    fn review(&self, units: &mut [Unit<'_>], held: &mut Vec<EffectOfUnits>) -> Result<(), Error> {
        let mut k = 0;
        while k < held.len() {
            let effect = held[k].effect.clone();
            let without = self.without(units, &effect)?;
            let pooled = pool(
                &without,
                &self.candidates,
                self.request.threshold(),
                &held[k].units,
            );
            let own = pooled.iter().find(|p| p.effect.name() == effect.name());
            let stays = own.is_some_and(|p| match held[k].is_shared {
                true => p.evidence > self.request.threshold() && p.is_shared(self.request.alpha),
                false => p.evidence > self.request.threshold(),
            });
            if stays {
                k += 1;
                continue;
            }
            for (unit, without) in units.iter_mut().zip(without) {
                *unit = without;
            }
            held.remove(k);
            k = 0;
        }
        Ok(())
    }

    fn without<'u>(&self, units: &[Unit<'u>], effect: &EffectRef) -> Result<Vec<Unit<'u>>, Error> {
        units.iter().map(|unit| unit.without(effect)).collect()
    }

    fn written(&self, units: &[Unit<'_>], held: &[EffectOfUnits]) -> Result<UnitFindings, Error> {
        let (mut shared, mut own) = (Vec::new(), Vec::new());
        for h in held {
            let without = self.without(units, &h.effect)?;
            let threshold = self.request.threshold();
            // Of what one unit alone shows the others are asked too.
            let among: &[bool] = if h.is_shared { &h.units } else { &[] };
            let pooled = pool(&without, &self.candidates, threshold, among);
            let Some(place) = pooled
                .iter()
                .position(|p| p.effect.name() == h.effect.name())
            else {
                continue;
            };
            let named = &pooled[place];
            let sizes = self.sizes(units, &without, h, named)?;
            if h.is_shared {
                shared.push(SharedEffect {
                    name: h.effect.name().into(),
                    adjusted_p_value: (-named.evidence).exp().min(1.0),
                    indistinguishable_from: named.ties(&pooled),
                    agreement: agreement(units, &h.effect, &h.units),
                    sizes,
                });
            } else {
                let alone = h.units.iter().position(|is_in| *is_in);
                let others = alone.and_then(|k| named.shown_by_others(k, &without, &h.effect));
                own.extend(
                    sizes
                        .into_iter()
                        .find(|s| !s.parameters.is_empty())
                        .map(|size| OwnEffect {
                            name: h.effect.name().into(),
                            others_would_show_it: others.unwrap_or(false),
                            size,
                        }),
                );
            }
        }
        Ok(UnitFindings {
            schema: UNITS_SCHEMA,
            shared,
            own,
            units: units.iter().map(Unit::alone).collect(),
        })
    }

    /// Computes the size of an effect in every unit, with the gap before and after.
    fn sizes(
        &self,
        units: &[Unit<'_>],
        without: &[Unit<'_>],
        held: &EffectOfUnits,
        named: &Pooled,
    ) -> Result<Vec<UnitSize>, Error> {
        let channel = named
            .channel(without, &held.effect)
            .unwrap_or(Channel::StaticNorm);
        let mut sizes = Vec::new();
        for (k, (unit, before)) in units.iter().zip(without).enumerate() {
            let says = named.units[k].as_ref().filter(|_| held.units[k]);
            let noise = unit.state.noise;
            sizes.push(UnitSize {
                unit: unit.name.clone(),
                p_value: says.map(|says| says.log_p.exp()),
                parameters: match held.units[k] {
                    true => unit.parameters(&held.effect)?,
                    false => Vec::new(),
                },
                channel,
                gap_before: gap_of(&before.misfits(noise), channel),
                gap_after: gap_of(&unit.misfits(noise), channel),
            });
        }
        Ok(sizes)
    }
}

#[cfg(test)]
mod tests;
