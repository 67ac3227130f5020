//! A name as it is written down.

use ::findings::Remedy;
use estimate::calibration::{Calibration, EffectParameter, EffectValues};
use estimate::methods::joint::BiasNoise;
use sensor::{EffectRef, Quantity, Sensor};

use super::beside::{Rival, rivals};
use super::{EffectFinding, RankedClaim};
use crate::family::Claim;
use crate::gap::held_out::{gap_of, held_out, held_out_as_after};
use crate::gap::sequence::{Misfit, Sequence};
use crate::propose::forms;
use crate::rank::Ranked;
use crate::request::Session;
use crate::search::{Name, Search};
use crate::state::State;

/// The final model with its misfits, in the fit and on blocks left out.
pub struct Final<'a> {
    state: &'a State,
    noise: BiasNoise,
    misfits: [Misfit; 3],
    held_out: Option<[Misfit; 3]>,
    calibration: &'a Calibration,
    rivals: Vec<Rival>,
    catalogue: &'a [EffectRef],
}

impl<'a> Final<'a> {
    /// Builds it from a search and the calibration of its final model.
    pub fn of(session: &'a Session<'_>, search: &'a Search, calibration: &'a Calibration) -> Self {
        let last = &search.last;
        let noise = last.noise;
        Self {
            state: last,
            noise,
            misfits: Sequence::of(last, noise).misfits(last),
            held_out: held_out(last, noise),
            calibration,
            rivals: rivals(search, session.request.threshold()),
            catalogue: &session.candidates,
        }
    }
}

/// The findings of all effects that a search named.
pub fn findings(
    session: &Session<'_>,
    search: &Search,
    calibration: &Calibration,
) -> Vec<EffectFinding> {
    let is_effect = |name: &&Name| matches!(name.claim, Claim::Effect(_));
    if !search.names.iter().any(|name| is_effect(&name)) {
        return Vec::new();
    }
    let last = Final::of(session, search, calibration);
    let names = search.names.iter().filter(is_effect);
    names.map(|name| finding(name, &last)).collect()
}

/// The finding of a name.
fn finding(name: &Name, last: &Final<'_>) -> EffectFinding {
    let without = &name.without;
    let noise = last.noise;
    let sequence = Sequence::of(without, noise);
    let channel = sequence.channel_of(&name.predicted());
    let held = |misfits: &Option<[Misfit; 3]>| misfits.map_or(1.0, |m| gap_of(&m, channel));
    let parameters = parameters_of(name.claim.name(), last.calibration);
    let rivals = last.rivals.iter();
    let beside =
        rivals.filter_map(|rival| rival.beside(name.claim.effect()?, &parameters, last.state));
    let ties: Vec<String> = name.ties.iter().map(|t| t.claim.name().into()).collect();
    EffectFinding {
        name: name.claim.name().into(),
        statistic: name.ranked.statistic,
        dof: name.ranked.dof,
        p_value: name.ranked.log_p.exp(),
        adjusted_p_value: adjusted(&name.ranked),
        told_apart_by: told_apart_by(&name.claim, name.ties.iter().map(|t| &t.claim)),
        indistinguishable_from: ties,
        shared: name.ties.iter().map(|t| t.shared).collect(),
        forms: forms(name, last.catalogue),
        rivals: name.ties.iter().filter_map(|t| t.rivalry.clone()).collect(),
        may_be_beside: beside.collect(),
        parameters,
        channel,
        gap_before: gap_of(&sequence.misfits(without), channel),
        gap_after: gap_of(&last.misfits, channel),
        gap_by_chance: last
            .misfits
            .get(channel as usize)
            .and_then(Misfit::gap_by_chance),
        rms_before: without.rms(channel),
        rms_after: last.state.rms(channel),
        held_out_gap_before: held(&held_out_as_after(without, last.state)),
        held_out_gap_after: held(&last.held_out),
    }
}

/// A recording that tells a named effect from what cannot be told from it in this one, by what they look at.
fn told_apart_by<'a>(
    name: &'a Claim,
    ties: impl ExactSizeIterator<Item = &'a Claim>,
) -> Option<Remedy> {
    if ties.len() == 0 {
        return None;
    }
    let effects = std::iter::once(name).chain(ties).filter_map(Claim::effect);
    let all: Vec<_> = effects
        .map(|effect| (effect.sensor(), effect.needs()))
        .collect();
    let any = |wanted: &[Quantity]| {
        let mut needs = all.iter().flat_map(|(_, needs)| needs);
        needs.any(|q| wanted.contains(q))
    };
    let only = |sensor: Sensor| {
        let own = (sensor, vec![Quantity::signal_of(sensor)]);
        all.contains(&own)
    };
    Some(if any(&[Quantity::TemperatureRate, Quantity::Warming]) {
        Remedy::TemperatureCycles
    } else if any(&[Quantity::Temperature]) && any(&[Quantity::Time]) {
        Remedy::WarmAndCool
    } else if any(&[Quantity::Time]) {
        Remedy::LongFromSwitchOn
    } else if only(Sensor::Gyroscope) {
        Remedy::SpeedsThatDiffer
    } else if only(Sensor::Accelerometer) {
        Remedy::TiltsBetweenFaces
    } else if any(&[Quantity::LastChange]) {
        Remedy::OtherSides
    } else if any(&[Quantity::SpecificForce, Quantity::Attitude]) {
        Remedy::LongRests
    } else {
        Remedy::OtherOrder
    })
}

/// `p` over the whole catalogue.
fn adjusted(ranked: &Ranked) -> f64 {
    (-ranked.evidence).exp().min(1.0)
}

/// The parameters of an effect in a calibration.
pub fn parameters_of(name: &str, calibration: &Calibration) -> Vec<EffectParameter> {
    let own = |effect: &&EffectValues| effect.name == name;
    calibration
        .effects
        .iter()
        .find(own)
        .map(|effect| effect.parameters.clone())
        .unwrap_or_default()
}

/// A place in the ranking.
pub fn ranked_claim(claim: &Claim, ranked: &Ranked) -> RankedClaim {
    RankedClaim {
        name: claim.name().into(),
        statistic: ranked.statistic,
        dof: ranked.dof,
        adjusted_p_value: adjusted(ranked),
    }
}
