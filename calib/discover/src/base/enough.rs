//! Check that a session has enough data for a search.

use findings::{Finding, Kind};
use recording::Error;

use crate::request::Session;
use crate::state::State;

/// Refuses a session without an accelerometer or with too few rests.
///
/// # Errors
/// [`Error::NotEnough`] with what to record.
pub fn enough_rests(session: &Session<'_>) -> Result<(), Error> {
    for (recording, _) in &session.recordings {
        if recording.accelerometer.is_none() {
            let found = Finding::of(Kind::AccelerometerNeeded);
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
    let found = Finding::of(Kind::TooFewForSearch)
        .in_recording(names(session))
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

/// Refuses a session that leaves nothing to compare once the base models are fitted.
///
/// # Errors
/// [`Error::NotEnough`].
pub fn enough_to_compare(session: &Session<'_>, base: &State) -> Result<(), Error> {
    if base.projected.dof() > 0 {
        return Ok(());
    }
    let found = Finding::of(Kind::NothingToCompare)
        .in_recording(names(session))
        .count("rows", base.rows())
        .detail("requirement", plan::REQUIREMENT.to_string());
    Err(Error::not_enough(found))
}

fn names(session: &Session<'_>) -> String {
    let names: Vec<&str> = session
        .recordings
        .iter()
        .map(|(r, _)| r.name.as_str())
        .collect();
    names.join(", ")
}
