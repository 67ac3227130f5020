//! The calibration of a final model, with what its recordings determine.

use ::findings::{Finding, Kind};
use estimate::calibrate::{
    Account, Frame, beside_the_others, count_motion, differences, is_determined, too_fast,
    written_down,
};
use estimate::calibration::Calibration;
use estimate::methods::joint::JointFit;
use recording::{Error, Recording};
use sensor::EffectRef;

use super::request::Session;
use super::search::Search;
use super::state::State;
use super::time_constants::{HeldShape, say_held, settle};

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
    let (fit, held) = determined(session, search, held)?;
    let mut calibration = written(&fit, session.request.latitude.is_some(), session)?;
    say_held(&mut calibration, &held);
    let fit = &search.last.fit;
    let differ = differences(fit, &session.recordings_of_parts(), true)?;
    let differ = differ.beside(&calibration.warnings);
    differ.enlarge(&mut calibration, fit);
    let warnings = &mut calibration.warnings;
    warnings.extend(unknown_temperature(&search.last));
    warnings.extend(differ.findings());
    warnings.extend(search.spent.clone());
    Ok(calibration)
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
    if let Some(gyroscope) = &calibration.gyroscope {
        let t = gyroscope.base().t;
        let each = session.recordings.iter();
        let found = each.filter_map(|(own, choice)| too_fast(own, &choice.segmentation, &t));
        calibration.warnings.extend(found);
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

/// The calibration of a fit.
fn written(
    fit: &JointFit,
    keeps_the_earth: bool,
    session: &Session<'_>,
) -> Result<Calibration, Error> {
    let (recordings, choices): (Vec<&Recording>, Vec<_>) = session.parts().unzip();
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

/// Withdraws names until these recordings determine the final model: where they leave a parameter open, the one goes without which they
/// do not, that with the most parameters first, or else the least evident one. Returns its full fit, and what they do not show of the shapes that
/// are left.
fn determined(
    session: &Session<'_>,
    search: &mut Search,
    mut held: Vec<HeldShape>,
) -> Result<(JointFit, Vec<HeldShape>), Error> {
    let mut fit = search.last.fitted_in_full(session)?;
    while !is_determined(&fit) {
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
            // One turn or two that are far off make all of them scatter.
            fit = search.last.fitted_without_outliers(session)?;
            break;
        };
        effects.sort_by_key(|effect| std::cmp::Reverse(effect.params().len()));
        let helps = |effect: &&EffectRef| {
            let state = search.fit(session, less(effect));
            let fit = state.and_then(|state| state.fitted_in_full(session));
            fit.is_ok_and(|fit| is_determined(&fit))
        };
        let gone = effects.iter().find(helps).cloned().unwrap_or(weakest);
        search.withdraw_to(session, less(&gone))?;
        held = settle(session, &mut search.last);
        fit = search.last.fitted_in_full(session)?;
    }
    Ok((fit, held))
}

/// Returns the finding that a temperature is missing from some of the recordings; `None` where none lacks it.
fn unknown_temperature(state: &State) -> Option<Finding> {
    let without = state.fit.data.without_thermometer();
    let names = without.join(" and ");
    (!without.is_empty()).then(|| Finding::of(Kind::TEMPERATURE_UNKNOWN).detail("without", names))
}
