//! Whether a session can show anything at all.

use recording::Error;

use super::request::Session;
use super::state::State;

/// Refuses a session without an accelerometer or with too few rests.
///
/// # Errors
/// [`Error::NotEnough`] with what to record.
pub fn enough_rests(session: &Session<'_>) -> Result<(), Error> {
    for (recording, _) in &session.recordings {
        if recording.accelerometer.is_none() {
            return Err(Error::not_enough(format!(
                "{}: no accelerometer: gravity is the reference that the model is checked against",
                recording.name
            )));
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
    Err(Error::not_enough(format!(
        "{}: {rests} static interval{}, too few to tell a missing effect from a scale factor; {}; {}",
        names(session),
        if rests == 1 { "" } else { "s" },
        plan::REQUIREMENT,
        wanted(session)
    )))
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
    Err(Error::not_enough(format!(
        "{}: the base models use up all {} readings: nothing is left that an effect could show in; {}; record \
         more placements",
        names(session),
        base.rows(),
        plan::REQUIREMENT
    )))
}

fn names(session: &Session<'_>) -> String {
    let names: Vec<&str> = session
        .recordings
        .iter()
        .map(|(r, _)| r.name.as_str())
        .collect();
    names.join(", ")
}
