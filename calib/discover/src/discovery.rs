//! The whole way from recordings to findings.

use std::borrow::Borrow;
use std::sync::Arc;

use estimate::calibrate::{
    Account, Frame, not_in_one_plane, of_one_device, own_effects, refuse_unobservable, written_down,
};
use estimate::calibration::{Calibration, EffectParameter, EffectValues};
use estimate::methods::joint::{BiasNoise, SensorNoise};
use estimate::methods::static_means;
use recording::{Error, Recording};
use sensor::{AnyEffect, Model, Nature, Sensor};

use super::enough::{enough_rests, enough_to_compare};
use super::family::{Claim, effect_family, is_late};
use super::fault::delay::{Delay, delay};
use super::fault::integrity::{SPOILT, disturbed, integrity, undersampled};
use super::fault::mixed::{explain_disturbed, leave_out_mixed, take_back};
use super::findings::{EffectFinding, FINDINGS_SCHEMA, Findings, RankedClaim, Verdict};
use super::flicker::{Found, names_and_rest};
use super::gap::channel::Channel;
use super::gap::held_out::{gap_of, held_out};
use super::gap::localise::disagreements;
use super::gap::sequence::{Misfit, Sequence, channel_of};
use super::propose::{Proposal, Proposed, instead_of_names, propose};
use super::rank::Ranked;
use super::remainder::unexplained::{Unexplained, rest_of};
use super::remainder::weighed_again::weighed_again;
use super::remainder::withdrawn::{
    weigh_beside_shape, without_doubtful_steps, without_steps_of, without_undetermined,
    without_weak,
};
use super::request::{Request, Session};
use super::search::{Name, Search};
use super::settle::{HeldShape, say_held, settle};
use super::state::State;
use super::visible::{NEVER_VISIBLE, told_apart_by};

/// Stamps are late beyond what delays of the gyroscope do if by more standard errors than this.
const MUCH_LATER: f64 = 3.0;

/// The findings with the models behind them, for pictures.
#[derive(Clone, Debug)]
pub struct Discovery {
    /// What was found.
    pub findings: Findings,
    /// The models.
    pub search: Search,
    /// The last of them with the proposed formula, where there is one.
    pub with_formula: Option<State>,
}

/// Finds what the base models lack.
///
/// # Errors
/// Recordings that cannot be cut or have too few rests, a fit that fails, a calibration that the data do not determine.
pub fn discover<R: Borrow<Recording>>(
    recordings: &[R],
    request: &Request,
) -> Result<Discovery, Error> {
    let recordings: Vec<&Recording> = recordings.iter().map(R::borrow).collect();
    own_effects::grant_steps(&request.catalogue, recordings.iter().copied());
    let mut discovery = discover_all(&recordings, request)?;
    let warnings = &mut discovery.findings.calibration.warnings;
    warnings.extend(own_effects::left_out(&request.catalogue));
    Ok(discovery)
}

fn discover_all(recordings: &[&Recording], request: &Request) -> Result<Discovery, Error> {
    discover_in(&mut Session::new(recordings, request)?, request)
}

/// The same in a session, which knows its clocks and whether its biases flicker afterwards.
pub(super) fn discover_in(
    session: &mut Session<'_>,
    request: &Request,
) -> Result<Discovery, Error> {
    enough_rests(session)?;
    let cuts = session.recordings.iter();
    let means: Vec<_> = cuts
        .map(|(r, choice)| static_means(r, &choice.segmentation))
        .collect();
    not_in_one_plane(&means)?;
    if !request.force_device {
        let of = session.recordings.iter().map(|(recording, _)| *recording);
        of_one_device(of.zip(means), request.gravity)?;
    }
    let base = State::fit(session, super::Extension::default())?;
    session.clocks = Some(base.fit.data.decided_clocks());
    session.base = Some(Arc::clone(&base.fit));
    refuse_unobservable(&base.fit)?;
    enough_to_compare(session, &base)?;
    let mut faults = integrity(session, &base);
    let is_spoilt = faults.iter().any(|fault| SPOILT.contains(&fault.name));
    let alpha = request.alpha_of_rest();
    let found = if is_spoilt {
        Found::nothing_looked_for(base)
    } else {
        names_and_rest(session, request, base)?
    };
    let (mut search, mut rest) = (found.search, found.rest);
    let instead =
        instead_of_names(session, request, &search, found.of_base).map(|(formula, mut whole)| {
            whole.instead_of = search.withdraw_all();
            rest = Some(whole);
            formula
        });
    if leave_out_mixed(session, &mut search)? {
        rest = rest_of(&search.last, alpha);
    }
    if rest.is_some() && without_weak(session, &mut search, request)? {
        rest = rest_of(&search.last, alpha);
    }
    if without_doubtful_steps(session, &mut search)? {
        rest = rest_of(&search.last, alpha);
    }
    if let Some((sensor, _)) = rest.as_ref().and_then(|found| found.wandering)
        && without_steps_of(session, &mut search, sensor)?
    {
        rest = rest_of(&search.last, alpha);
    }
    let mut fewer = search.clone();
    if without_undetermined(session, &mut fewer)? {
        let left = rest_of(&fewer.last, alpha);
        // What nothing would explain without it is not by chance.
        if rest.is_some() || left.is_none() {
            (search, rest) = (fewer, left);
        }
    }
    if take_back(session, &mut search)? {
        rest = rest_of(&search.last, alpha);
    }
    explain_disturbed(session, &mut search)?;
    if let Some(found) = rest.as_mut() {
        weigh_beside_shape(session, request, &mut search, found)?;
    }
    let late = (!is_spoilt).then(|| late(&search.last, request)).flatten();
    if let Some((effect, late)) = late {
        let mut extension = search.last.extension.clone();
        extension.effects.push((effect, Some((0, late.delay))));
        search.last = search.fit(session, extension)?;
    }
    let held = settle(session, &mut search.last);
    let proposed = match &rest {
        Some(rest) => proposal(session, request, &mut search, rest, instead)?,
        None => None,
    };
    let (proposed, with_formula) = proposed.unzip();
    let (mut calibration, held) = determined(session, request, &mut search, held)?;
    say_held(&mut calibration, &held);
    calibration.warnings.extend(search.spent.clone());
    let named = |name: &&Name| matches!(name.claim, Claim::Effect(_));
    let mut effects = Vec::new();
    if search.names.iter().any(|name| named(&name)) {
        let last = Final::of(&search.last, &calibration);
        let names = search.names.iter().filter(named);
        effects.extend(names.map(|name| finding(name, &last)));
    }
    if let Some((effect, late)) = late {
        let again = delay(&search.last);
        effects.push(late_finding(
            effect,
            &late,
            again,
            request,
            &mut calibration,
        ));
    }
    let lasting = disturbed(&search.last, &faults, &search.either);
    faults.extend(lasting);
    faults.extend(undersampled(&search.last));
    let named = !effects.is_empty() || !faults.is_empty();
    let verdict = match (named, rest.is_some()) {
        (false, false) => Verdict::Nothing,
        (true, false) => Verdict::Named,
        (false, true) => Verdict::Unexplained,
        (true, true) => Verdict::NamedAndUnexplained,
    };
    let inputs = session.recordings.iter();
    let inputs = inputs.map(|(r, choice)| (*r, Some(&choice.segmentation)));
    calibration.state_inputs(inputs, None);
    let findings = Findings {
        schema: FINDINGS_SCHEMA,
        verdict,
        effects,
        integrity: faults,
        unexplained: rest,
        proposed,
        // What chance and a wandering bias explain is no disagreement.
        disagreement: match verdict {
            Verdict::Nothing => Vec::new(),
            _ => disagreements(&search.base, search.last.noise),
        },
        ranking: search
            .first_ranking
            .iter()
            .map(|(c, r)| ranked_claim(c, r))
            .collect(),
        not_observable: search.not_observable.clone(),
        never_visible: NEVER_VISIBLE.to_vec(),
        validation: Vec::new(),
        walks: search.last.noise.walk,
        bias_instability: search.last.noise.flicker,
        white: white(&search.last),
        calibration,
    };
    Ok(Discovery {
        findings,
        search,
        with_formula,
    })
}

pub(super) fn calibration(
    session: &Session<'_>,
    last: &State,
    request: &Request,
) -> Result<Calibration, Error> {
    let recordings: Vec<&Recording> = session.recordings.iter().map(|(r, _)| *r).collect();
    let choices: Vec<_> = session.recordings.iter().map(|(_, c)| c).collect();
    let mut warnings = session.cut_down.clone();
    let account = Account {
        gravity: request.gravity,
        gravity_source: request.gravity_source,
        latitude: None,
        frame: Frame::default(),
        names_what_is_missing: true,
    };
    let calibration = written_down(&last.fit, &recordings, &choices, &account, &mut warnings)?;
    let mut calibration = Calibration {
        warnings,
        ..calibration
    };
    calibration.carry_gravity(request.gravity_source);
    Ok(calibration)
}

/// The calibration of the final model, with the names that these recordings determine: where they leave a parameter open,
/// the one goes without which they do not, that with the most parameters first, or else the least evident one.
fn determined(
    session: &Session<'_>,
    request: &Request,
    search: &mut Search,
    mut held: Vec<HeldShape>,
) -> Result<(Calibration, Vec<HeldShape>), Error> {
    loop {
        let refused = match calibration(session, &search.last, request) {
            Ok(calibration) => return Ok((calibration, held)),
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Err(refused) => refused,
        };
        let extension = search.last.extension.clone();
        let less = |effect: &dyn AnyEffect| {
            let mut less = extension.clone();
            less.settles = false;
            less.effects.retain(|(own, _)| own.name() != effect.name());
            less
        };
        let effects = search.names.iter().filter_map(|name| match name.claim {
            Claim::Effect(effect) => Some(effect),
            _ => None,
        });
        let mut effects: Vec<&'static dyn AnyEffect> = effects.collect();
        let Some(weakest) = effects.last().copied() else {
            return Err(refused);
        };
        effects.sort_by_key(|effect| std::cmp::Reverse(effect.params().len()));
        let helps = |effect: &&&'static dyn AnyEffect| {
            let state = search.fit(session, less(**effect));
            state.is_ok_and(|state| calibration(session, &state, request).is_ok())
        };
        let gone = effects.iter().find(helps).copied().unwrap_or(weakest);
        search.withdraw_to(session, less(gone))?;
        held = settle(session, &mut search.last);
    }
}

/// A formula for what remains, or that is `known` to explain it, with its coefficients; names that it explains are
/// withdrawn, and the formula is then looked for without them.
fn proposal(
    session: &Session<'_>,
    request: &Request,
    search: &mut Search,
    rest: &Unexplained,
    known: Option<Proposed>,
) -> Result<Option<(Proposal, State)>, Error> {
    let found = known.or_else(|| propose(session, request, &search.last, rest));
    let Some(mut proposed) = found else {
        return Ok(None);
    };
    let family = effect_family(&search.base, proposed.effect, &[]);
    let noise = proposed.state.noise;
    if let Some(less) = weighed_again(search, request, &family.columns.to_dense(), noise) {
        search.withdraw_to(session, less)?;
        let Some(again) = propose(session, request, &search.last, rest) else {
            return Ok(None);
        };
        proposed = again;
    }
    // A formula whose parameters these recordings do not determine is none.
    let Ok(calibration) = calibration(session, &proposed.state, request) else {
        return Ok(None);
    };
    let parameters = parameters_of(proposed.effect.name(), &calibration);
    let state = proposed.state.clone();
    Ok(Some((proposed.written(rest.channel, parameters), state)))
}

/// The final model with its misfits, in the fit and on blocks left out.
struct Final<'a> {
    state: &'a State,
    noise: BiasNoise,
    misfits: [Misfit; 3],
    held_out: Option<[Misfit; 3]>,
    calibration: &'a Calibration,
}

impl<'a> Final<'a> {
    fn of(last: &'a State, calibration: &'a Calibration) -> Self {
        let noise = last.noise;
        Self {
            state: last,
            noise,
            misfits: Sequence::of(last, noise).misfits(last),
            held_out: held_out(last, noise),
            calibration,
        }
    }
}

fn finding(name: &Name, last: &Final<'_>) -> EffectFinding {
    let without = &name.without;
    let noise = last.noise;
    let sequence = Sequence::of(without, noise);
    let channel = channel_of(&sequence.of_column(name.predicted.col_as_slice(0)));
    let held = |misfits: &Option<[Misfit; 3]>| misfits.map_or(1.0, |m| gap_of(&m, channel));
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
        rivals: name.ties.iter().filter_map(|t| t.rivalry.clone()).collect(),
        parameters: parameters_of(name.claim.name(), last.calibration),
        channel,
        gap_before: gap_of(&sequence.misfits(without), channel),
        gap_after: gap_of(&last.misfits, channel),
        rms_before: without.rms(channel),
        rms_after: last.state.rms(channel),
        held_out_gap_before: held(&held_out(without, noise)),
        held_out_gap_after: held(&last.held_out),
    }
}

/// White noise densities at low frequency of the first recording, the mean of the axes.
fn white(state: &State) -> [f64; 2] {
    let source = state.fit.data.sources.first();
    let density = |noise: Option<&SensorNoise>| {
        noise.map_or(0.0, |n| {
            n.white.component_mul(&n.long_run).mean() * n.interval.sqrt()
        })
    };
    [
        density(source.and_then(|s| s.accelerometer.as_ref())),
        density(source.and_then(|s| s.gyroscope.as_ref())),
    ]
}

/// The effect of late stamps, where the moving accelerometer shows it.
fn late(state: &State, request: &Request) -> Option<(&'static dyn AnyEffect, Delay)> {
    let candidates = request.candidates();
    let effect = candidates.iter().find(|e| is_late(**e))?;
    let found = delay(state)?;
    // What delays the gyroscope's axes delays them against the accelerometer too.
    if found.delay.abs() <= 2.0 * gyroscope_delay(state) + MUCH_LATER * found.std {
        return None;
    }
    (late_evidence(&found, candidates.len()) > request.threshold()).then_some((*effect, found))
}

/// The longest delay of an axis of the gyroscope against another in the model, s.
fn gyroscope_delay(state: &State) -> f64 {
    let effects = state.fit.models.iter().flat_map(Model::effects);
    let delays: Vec<_> = effects
        .filter(|e| e.nature() == Nature::Delay && e.sensor() == Sensor::Gyroscope)
        .collect();
    let fitted = &state.fit.parameters;
    let named = fitted.names().iter().zip(fitted.values());
    let of_delay = named.filter(|(name, _)| delays.iter().any(|e| name.starts_with(e.name())));
    of_delay.map(|(_, d)| d.abs()).fold(0.0, f64::max)
}

fn late_evidence(found: &Delay, candidates: usize) -> f64 {
    -found.log_p - (2.0 * candidates as f64).ln()
}

/// `again` is the delay that remains with the effect in the model: its gap is that after.
fn late_finding(
    effect: &dyn AnyEffect,
    found: &Delay,
    again: Option<Delay>,
    request: &Request,
    calibration: &mut Calibration,
) -> EffectFinding {
    let name = effect.name();
    for effect in calibration.effects.iter_mut().filter(|e| e.name == name) {
        for p in &mut effect.parameters {
            p.std = Some(found.std);
        }
    }
    EffectFinding {
        name: name.into(),
        statistic: found.statistic,
        dof: 1.0,
        p_value: found.log_p.exp(),
        adjusted_p_value: (-late_evidence(found, request.candidates().len()))
            .exp()
            .min(1.0),
        indistinguishable_from: Vec::new(),
        shared: Vec::new(),
        rivals: Vec::new(),
        told_apart_by: None,
        parameters: parameters_of(name, calibration),
        channel: Channel::MovingForce,
        gap_before: found.gap_before,
        rms_before: None,
        rms_after: None,
        gap_after: again.map_or(found.gap_before, |again| again.gap_before),
        held_out_gap_before: found.held_out_gap_before,
        held_out_gap_after: found.held_out_gap_after,
    }
}

fn adjusted(ranked: &Ranked) -> f64 {
    (-ranked.evidence).exp().min(1.0)
}

pub(super) fn parameters_of(name: &str, calibration: &Calibration) -> Vec<EffectParameter> {
    let own = |effect: &&EffectValues| effect.name == name;
    calibration
        .effects
        .iter()
        .find(own)
        .map(|effect| effect.parameters.clone())
        .unwrap_or_default()
}

fn ranked_claim(claim: &Claim, ranked: &Ranked) -> RankedClaim {
    RankedClaim {
        name: claim.name().into(),
        statistic: ranked.statistic,
        dof: ranked.dof,
        adjusted_p_value: adjusted(ranked),
    }
}
