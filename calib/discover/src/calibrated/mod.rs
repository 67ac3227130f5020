//! The calibration of a final model, with what its recordings determine.

mod settle;

use ::findings::{Finding, Kind};
use estimate::calibrate::{
    Account, Frame, beside_the_others, count_motion, gyroscope_of_one_device, written_down,
};
use estimate::calibration::Calibration;
use estimate::methods::earth;
use estimate::methods::joint::{JointFit, JointRequest, fit_joint};
use recording::{Error, Recording};
use sensor::EffectRef;
pub(crate) use settle::{HeldShape, settle};

use self::settle::say_held;
use super::request::Session;
use super::search::Search;
use super::state::State;

/// The calibration of the final model, `held` what its recordings do not show of the shapes of named effects; with what is to be said of the
/// recordings.
///
/// # Errors
/// A model whose parameters these recordings do not determine, however few names are left.
pub(super) fn calibrated(
    session: &Session<'_>,
    search: &mut Search,
    held: Vec<HeldShape>,
) -> Result<Calibration, Error> {
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
    Ok(calibration)
}

/// The same with the magnetometer, in which nothing is looked for: the file takes the place of a calibration.
pub(super) fn with_magnetometer(
    session: &Session<'_>,
    calibration: Calibration,
) -> Result<Calibration, Error> {
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
    calibration_that(session.request.latitude.is_some(), session, last)
}

/// The same, which may keep the earth's rotation in corrected rates though no latitude is given.
pub(super) fn calibration_that(
    keeps_the_earth: bool,
    session: &Session<'_>,
    last: &State,
) -> Result<Calibration, Error> {
    written(&last.fit, keeps_the_earth, session)
}

/// The final model with what the search leaves out, `None` where that is nothing. Where nobody says the latitude the earth's rotation is
/// uncertainty: at rest its vertical part does what the diagonal of a g-sensitivity does, and the rotation is one of the things that are
/// looked for. Where the device turns at rest, rates and turns scatter by that.
fn fitted_again(session: &Session<'_>, last: &State) -> Result<Option<JointFit>, Error> {
    let request = session.joint(&last.extension);
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
            less.effects.retain(|(own, _)| own.name() != effect.name());
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
