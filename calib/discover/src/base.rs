//! The base models, fitted to recordings that are enough and of one device.

use std::sync::Arc;

use estimate::calibrate::{
    differences, not_in_one_plane, of_one_device, of_one_recording_each, readings_of_the_device,
    refuse_unobservable,
};
use estimate::methods::static_means;
use findings::{Finding, Kind};
use recording::Error;

use super::request::Session;
use super::state::{Extension, State};

/// The base models; the session knows its clocks and the fit afterwards.
///
/// # Errors
/// Too few rests, rests in one plane, parameters that they do not determine, recordings of different devices, and those of the joint fit.
pub(super) fn base(session: &mut Session<'_>) -> Result<State, Error> {
    let names = names(session);
    enough_rests(session, &names)?;
    let cuts = session.recordings.iter();
    let means: Vec<_> = cuts
        .map(|(r, choice)| static_means(r, &choice.segmentation))
        .collect();
    let cut = session.recordings.iter();
    let cut = cut.map(|(recording, choice)| (recording.as_ref(), &choice.segmentation));
    readings_of_the_device(cut.clone())?;
    not_in_one_plane(&means)?;
    if !session.request.force_device {
        of_one_recording_each(cut, session.request.gravity)?;
        of_one_device(&session.ready(), &means, session.request.gravity)?;
    }
    let base = State::fit(session, Extension::default())?;
    session.clocks = Some(base.fit.data.decided_clocks());
    session.base = Some(Arc::clone(&base.fit));
    refuse_unobservable(&base.fit)?;
    if base.projected.dof() == 0 {
        let found = Finding::of(Kind::NOTHING_TO_COMPARE)
            .in_recording(names)
            .count("rows", base.rows())
            .detail("requirement", plan::REQUIREMENT.to_string());
        return Err(Error::not_enough(found));
    }
    if !session.request.force_device {
        differences(&base.fit, &session.recordings_of_parts(), false)?;
    }
    Ok(base)
}

/// Refuses a session without an accelerometer or with too few rests.
///
/// # Errors
/// [`Error::NotEnough`] with what to record.
fn enough_rests(session: &Session<'_>, names: &str) -> Result<(), Error> {
    for (recording, _) in &session.recordings {
        if recording.accelerometer.is_none() {
            let found = Finding::of(Kind::ACCELEROMETER_NEEDED);
            return Err(Error::not_enough(found.in_recording(&recording.name)));
        }
    }
    let rests: usize = session
        .recordings
        .iter()
        .map(|(_, choice)| choice.segmentation.statics.len())
        .sum();
    if rests >= plan::REQUIREMENT.placements {
        return Ok(());
    }
    let found = Finding::of(Kind::TOO_FEW_FOR_SEARCH)
        .in_recording(names)
        .count("count", rests)
        .detail("requirement", plan::REQUIREMENT.to_string())
        .detail("wanted", wanted(session));
    Err(Error::not_enough(found))
}

/// The placements to add, from the directions of the readings at rest.
fn wanted(session: &Session<'_>) -> String {
    let recordings = session.recordings.iter();
    let statics = recordings.flat_map(|(_, choice)| &choice.segmentation.statics);
    let readings: Vec<_> = statics
        .filter_map(|rest| Some(rest.accelerometer?.mean.normalize()))
        .collect();
    plan::coverage(&readings).advice()
}

/// The names of the recordings, in their order.
fn names(session: &Session<'_>) -> String {
    let names: Vec<&str> = session
        .recordings
        .iter()
        .map(|(r, _)| r.name.as_str())
        .collect();
    names.join(", ")
}
