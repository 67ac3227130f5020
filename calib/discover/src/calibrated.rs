//! The calibration of a final model, with what its recordings determine: its names, their time constants, a formula.

use std::ops::Range;

use ::findings::{Finding, Kind};
use estimate::calibrate::{
    Account, Frame, beside_the_others, count_motion, gyroscope_of_one_device, written_down,
};
use estimate::calibration::Calibration;
use estimate::methods::earth;
use estimate::methods::joint::{JointFit, JointRequest, fit_joint};
use recording::{Error, Recording};
use sensor::{EffectRef, Param, Role};
use solver::Parameters;

use super::family::{effect_family, tried};
use super::findings::named::parameters_of;
use super::propose::{Proposal, Proposed, propose};
use super::remainder::unexplained::Unexplained;
use super::remainder::withdrawn::weighed_again;
use super::request::Session;
use super::search::Search;
use super::state::{State, joint_request};

/// A time constant so many times beyond those tried is none that the recording shows.
const BEYOND_TRIED: f64 = 3.0;

/// The final model as it is written down: the formula for what remains, with the model that has it, and the calibration with what is to
/// be said of the recordings.
///
/// # Errors
/// A model whose parameters these recordings do not determine, however few names are left.
pub(super) fn calibrated(
    session: &Session<'_>,
    search: &mut Search,
    rest: Option<&Unexplained>,
    instead: Option<Proposed>,
) -> Result<(Option<(Proposal, State)>, Calibration), Error> {
    let held = settle(session, &mut search.last);
    let formula = match rest {
        Some(rest) => proposed(session, search, rest, instead)?,
        None => None,
    };
    let (calibration, held) = determined(session, search, held)?;
    let mut calibration = match fitted_again(session, &search.last)? {
        Some(fit) => written(&fit, session.request.latitude.is_some(), session)?,
        None => calibration,
    };
    say_held(&mut calibration, &held);
    let warnings = &mut calibration.warnings;
    warnings.extend(unknown_temperature(&search.last));
    warnings.extend(gyroscope_of_one_device(
        &search.last.fit,
        &session.ready(),
        true,
    )?);
    warnings.extend(search.spent.clone());
    Ok((formula, calibration))
}

/// The calibration with the magnetometer, in which nothing is looked for. Where `last` has a rotation that is the earth's or a field's of
/// the room, corrected rates keep it.
pub(super) fn completed(
    session: &Session<'_>,
    last: &State,
    mut calibration: Calibration,
    is_of_a_room: bool,
) -> Result<Calibration, Error> {
    if is_of_a_room {
        calibration = Calibration {
            warnings: calibration.warnings,
            ..written(&last.fit, true, session)?
        };
    }
    let choices: Vec<_> = session.recordings.iter().map(|(_, c)| c).collect();
    beside_the_others(
        calibration,
        &session.ready(),
        &choices,
        session.request.latitude,
    )
}

/// The calibration of a model.
pub(super) fn calibration(session: &Session<'_>, last: &State) -> Result<Calibration, Error> {
    written(&last.fit, session.request.latitude.is_some(), session)
}

/// The final model with what the search leaves out, `None` where that is nothing. Where nobody says the latitude the earth's rotation is
/// uncertainty: at rest its vertical part does what the diagonal of a g-sensitivity does, and the rotation is one of the things that are
/// looked for. Where the device turns at rest, rates and turns scatter by that.
fn fitted_again(session: &Session<'_>, last: &State) -> Result<Option<JointFit>, Error> {
    let request = joint_request(session, &last.extension);
    let of_the_earth = request.gyroscope.effects();
    let earth = session.request.latitude.is_none() && !earth::is_among(of_the_earth);
    let turns = session.remarks.has(Kind::RestsTurn);
    if !earth && !turns {
        return Ok(None);
    }
    let fit = fit_joint(&JointRequest {
        earth,
        disturbances: turns,
        compared: false,
        before: Some(&*last.fit).filter(|_| !turns),
        from_its_minimum: request.from_its_minimum && !turns,
        ..request
    })?;
    Ok(Some(fit))
}

/// The calibration of a fit.
fn written(
    fit: &JointFit,
    keeps_the_earth: bool,
    session: &Session<'_>,
) -> Result<Calibration, Error> {
    let recordings: Vec<&Recording> = session.ready();
    let choices: Vec<_> = session.recordings.iter().map(|(_, c)| c).collect();
    let mut warnings = session.remarks.clone();
    let account = Account {
        gravity: session.request.gravity,
        gravity_source: session.request.gravity_source,
        latitude: session.request.latitude,
        keeps_the_earth,
        frame: Frame::default(),
        names_what_is_missing: true,
    };
    let calibration = written_down(fit, &recordings, &choices, &account, &mut warnings)?;
    let mut calibration = Calibration {
        warnings,
        ..calibration
    };
    count_motion(&mut calibration);
    calibration.carry_gravity(session.request.gravity_source);
    Ok(calibration)
}

/// The calibration of the final model, with the names that these recordings determine: where they leave a parameter open,
/// the one goes without which they do not, that with the most parameters first, or else the least evident one.
fn determined(
    session: &Session<'_>,
    search: &mut Search,
    mut held: Vec<HeldShape>,
) -> Result<(Calibration, Vec<HeldShape>), Error> {
    loop {
        let refused = match calibration(session, &search.last) {
            Ok(calibration) => return Ok((calibration, held)),
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Err(refused) => refused,
        };
        let extension = search.last.extension.clone();
        let less = |effect: &EffectRef| {
            let mut less = extension.clone();
            less.settles = false;
            less.remove(effect.name());
            less
        };
        let effects = search.names.iter().filter_map(|name| name.claim.effect());
        let mut effects: Vec<EffectRef> = effects.cloned().collect();
        let Some(weakest) = effects.last().cloned() else {
            return Err(refused);
        };
        effects.sort_by_key(|effect| std::cmp::Reverse(effect.params().len()));
        let helps = |effect: &&EffectRef| {
            let state = search.fit(session, less(effect));
            state.is_ok_and(|state| calibration(session, &state).is_ok())
        };
        let gone = effects.iter().find(helps).cloned().unwrap_or(weakest);
        search.withdraw_to(session, less(&gone))?;
        held = settle(session, &mut search.last);
    }
}

/// Returns the finding that a temperature is missing from some of the recordings; `None` where none lacks it.
fn unknown_temperature(state: &State) -> Option<Finding> {
    let without = state.fit.data.without_thermometer();
    let names = without.join(" and ");
    (!without.is_empty()).then(|| Finding::of(Kind::TemperatureUnknown).detail("without", names))
}

/// A formula for what remains, or that is `known` to explain it, with its coefficients; names that it explains are
/// withdrawn, and the formula is then looked for without them.
fn proposed(
    session: &Session<'_>,
    search: &mut Search,
    rest: &Unexplained,
    known: Option<Proposed>,
) -> Result<Option<(Proposal, State)>, Error> {
    let found = known.or_else(|| propose(session, &search.last, rest));
    let Some(mut proposed) = found else {
        return Ok(None);
    };
    let family = effect_family(&search.base, &proposed.effect, &[]);
    let noise = proposed.state.noise;
    if let Some(less) = weighed_again(search, session, &family.columns.to_dense(), noise) {
        search.withdraw_to(session, less)?;
        let Some(again) = propose(session, &search.last, rest) else {
            return Ok(None);
        };
        proposed = again;
    }
    // A formula whose parameters these recordings do not determine is none.
    let Ok(calibration) = calibration(session, &proposed.state) else {
        return Ok(None);
    };
    let parameters = parameters_of(proposed.effect.name(), &calibration);
    let state = proposed.state.clone();
    Ok(Some((proposed.written(rest.channel, parameters), state)))
}

/// A time constant that these recordings do not show.
struct HeldShape {
    effect: String,
    parameter: Param,
    value: f64,
}

impl HeldShape {
    /// Returns true if the fitted value of the parameter is near those tried.
    fn is_shown_by(&self, fitted: &Parameters) -> bool {
        let place = fitted.index(&format!("{}.{}", self.effect, self.parameter.name));
        place.is_some_and(|k| near(&self.parameter).contains(&fitted.values()[k]))
    }
}

/// Fits the time constants of effects, where they come out near what was tried: amplitudes are no better known than
/// that. The effects of which they do not, with the parameter and its value.
///
/// Whatever else shapes an effect stays: the delay of late stamps is measured where no fit of static intervals sees it.
fn settle(session: &Session<'_>, last: &mut State) -> Vec<HeldShape> {
    let effects = last.extension.effects.iter();
    let shaped = effects.filter_map(|(effect, shape)| {
        let (k, value) = (*shape)?;
        let parameter = &effect.params()[k];
        (parameter.role_by_name() == Role::TimeConstant).then_some(HeldShape {
            effect: effect.name().to_owned(),
            parameter: parameter.clone(),
            value,
        })
    });
    let held: Vec<HeldShape> = shaped.collect();
    if held.is_empty() {
        return held;
    }
    let mut extension = last.extension.clone();
    extension.settles = true;
    let Ok(settled) = State::fit(session, extension) else {
        return held;
    };
    let fitted = &settled.fit.parameters;
    // Where the recording does not show a time constant, its fit wanders along a valley without an end.
    let converged = settled.fit.ending.termination.converged();
    if converged && held.iter().all(|shape| shape.is_shown_by(fitted)) {
        *last = settled;
        return Vec::new();
    }
    held
}

/// Amplitudes beside a time constant that was supposed and not fitted have no standard error that holds.
fn say_held(calibration: &mut Calibration, held: &[HeldShape]) {
    for HeldShape {
        effect,
        parameter: Param { name, unit, .. },
        value,
    } in held
    {
        for own in calibration.effects.iter_mut().filter(|e| e.name == *effect) {
            own.parameters.iter_mut().for_each(|p| p.std = None);
        }
        calibration.warnings.push(
            Finding::of(Kind::TimeConstantSupposed)
                .detail("effect", effect.clone())
                .detail("parameter", &**name)
                .detail("value", format!("{value} {unit}")),
        );
    }
}

/// From a third of the least value tried to three times the largest.
fn near(p: &Param) -> Range<f64> {
    let tried = tried(p);
    let least = tried.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = tried.iter().copied().fold(0.0, f64::max);
    least / BEYOND_TRIED..largest * BEYOND_TRIED
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use crate::{Request, discover};

    #[test]
    fn late_stamps_are_measured_and_not_said_to_be_supposed() {
        let spec = Spec::hand_held(3).with_effect("time_offset", 3.0);
        let recordings = [spec.run().unwrap().recording];
        let findings = discover(&recordings, &Request::new(spec.gravity))
            .unwrap()
            .findings;
        assert!(findings.effects.iter().any(|e| e.name == "time_offset"));
        let warnings = findings
            .calibration
            .warnings
            .texts(::findings::Front::CommandLine);
        let supposed = warnings.iter().find(|w| w.contains("is supposed to be"));
        assert_eq!(supposed, None);
    }
}
