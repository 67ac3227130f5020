//! The whole way from recordings to findings.

use ::findings::{Finding, Kind};
use std::borrow::Borrow;
use std::sync::Arc;

use estimate::calibrate::{
    Account, Frame, gyroscope_of_one_device, not_in_one_plane, of_one_device,
    of_one_recording_each, own_effects, refuse_unobservable, written_down,
};
use estimate::calibration::Calibration;
use estimate::methods::joint::SensorNoise;
use estimate::methods::static_means;
use recording::{Error, Recording};
use sensor::AnyEffect;

use super::enough::{enough_rests, enough_to_compare};
use super::family::{Claim, effect_family};
use super::fault::delay::delay;
use super::fault::integrity::{SPOILT, disturbed, integrity};
use super::fault::undersampled::undersampled;
use super::findings::late::{late, late_apart, late_finding};
use super::findings::named::{Final, finding, parameters_of, ranked_claim};
use super::findings::room::described;
use super::findings::typed::of_discovery;
use super::findings::{FINDINGS_SCHEMA, Findings, Verdict};
use super::gap::localise::disagreements;
use super::judgement::{Judged, judged};
use super::propose::{Proposal, Proposed, propose};
use super::remainder::unexplained::Unexplained;
use super::remainder::weighed_again::weighed_again;
use super::request::{Request, Session};
use super::search::{Name, Search};
use super::settle::{HeldShape, say_held, settle};
use super::state::State;
use super::visible::never_visible;

/// The chance that stamps which are late by the same in all recordings are said to be late by different times.
const LATE_APART: f64 = 1e-3;

/// The findings with the models behind them, for pictures.
#[derive(Clone, Debug)]
pub struct Discovery {
    /// Findings of the search, as written to findings.json.
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
    let mut discovery = discover_in(&mut Session::new(&recordings, request)?, request)?;
    let warnings = &mut discovery.findings.calibration.warnings;
    warnings.extend(own_effects::left_out(&request.catalogue));
    Ok(discovery)
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
        let cut = session.recordings.iter();
        let cut = cut.map(|(recording, choice)| (recording.as_ref(), &choice.segmentation));
        of_one_recording_each(cut, request.gravity)?;
        of_one_device(&session.ready(), &means, request.gravity)?;
    }
    let base = State::fit(session, super::Extension::default())?;
    session.clocks = Some(base.fit.data.decided_clocks());
    session.base = Some(Arc::clone(&base.fit));
    refuse_unobservable(&base.fit)?;
    enough_to_compare(session, &base)?;
    if !request.force_device {
        gyroscope_of_one_device(&base.fit, &session.ready(), false)?;
    }
    let mut faults = integrity(session, &base);
    let is_spoilt = faults.iter().any(|fault| SPOILT.contains(&fault.name));
    let Judged {
        mut search,
        rest,
        instead,
    } = match is_spoilt {
        true => Judged::nothing_looked_for(base),
        // A formula whose parameters these recordings do not determine takes no name's place.
        false => judged(session, request, base, |session, state| {
            calibration(session, state, request).is_ok()
        })?,
    };
    let apart = match is_spoilt {
        true => Vec::new(),
        false => late_apart(&search.last, request, LATE_APART),
    };
    let looks = !is_spoilt && apart.is_empty();
    let late = looks.then(|| late(&search.last, request)).flatten();
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
    calibration
        .warnings
        .extend(unknown_temperature(&search.last));
    let another = gyroscope_of_one_device(&search.last.fit, &session.ready(), true)?;
    calibration.warnings.extend(another);
    calibration.warnings.extend(search.spent.clone());
    let named = |name: &&Name| matches!(name.claim, Claim::Effect(_));
    let mut effects = Vec::new();
    if search.names.iter().any(|name| named(&name)) {
        let last = Final::of(&search, &calibration, request);
        let names = search.names.iter().filter(named);
        effects.extend(names.map(|name| finding(name, &last)));
        let doubts = effects.iter().filter_map(|e| e.latitude_in_doubt.clone());
        calibration.warnings.extend(doubts);
    }
    let (rest, is_of_a_room) = described(&mut effects, &mut search, rest);
    if is_of_a_room {
        let warnings = std::mem::take(&mut calibration.warnings);
        calibration = Calibration {
            warnings,
            ..calibration_that(true, session, &search.last, request)?
        };
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
    faults.extend(apart);
    faults.extend(undersampled(&search.last));
    let named = !effects.is_empty() || !faults.is_empty();
    let verdict = match (named, rest.is_some()) {
        (false, false) => Verdict::Nothing,
        (true, false) => Verdict::Named,
        (false, true) => Verdict::Unexplained,
        (true, true) => Verdict::NamedAndUnexplained,
    };
    let cut = session.recordings.iter();
    let cut = cut.map(|(_, choice)| Some(&choice.segmentation));
    let inputs = session.originals.iter().copied().zip(cut);
    calibration.state_inputs(inputs, None);
    calibration
        .warnings
        .extend(of_discovery(&effects, &faults, rest.as_ref()));
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
        never_visible: never_visible(),
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

/// Returns the finding that a temperature is missing from some of the recordings; `None` where none lacks it.
fn unknown_temperature(state: &State) -> Option<Finding> {
    let without = state.fit.data.without_thermometer();
    let names = without.join(" and ");
    (!without.is_empty()).then(|| Finding::of(Kind::TemperatureUnknown).detail("without", names))
}

/// The calibration of a model.
pub(super) fn calibration(
    session: &Session<'_>,
    last: &State,
    request: &Request,
) -> Result<Calibration, Error> {
    calibration_that(request.latitude.is_some(), session, last, request)
}

/// The same, which may keep the earth's rotation in corrected rates though no latitude is given.
fn calibration_that(
    keeps_the_earth: bool,
    session: &Session<'_>,
    last: &State,
    request: &Request,
) -> Result<Calibration, Error> {
    let recordings: Vec<&Recording> = session.ready();
    let choices: Vec<_> = session.recordings.iter().map(|(_, c)| c).collect();
    let mut warnings = session.remarks.clone();
    let account = Account {
        gravity: request.gravity,
        gravity_source: request.gravity_source,
        latitude: request.latitude,
        keeps_the_earth,
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
