//! Whether a session can show anything at all.

use super::request::Session;
use super::state::State;
use crate::error::Error;

/// Rests below which the base models alone use up what the data say.
const FEWEST_RESTS: usize = 9;

/// Refuses a session without an accelerometer or with too few rests.
///
/// # Errors
/// [`Error::NotEnough`] with what to record.
pub fn enough_rests(session: &Session<'_>) -> Result<(), Error> {
    for (recording, _) in &session.recordings {
        if recording.accelerometer.is_none() {
            return Err(Error::NotEnough(format!(
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
    if rests >= FEWEST_RESTS {
        return Ok(());
    }
    Err(Error::NotEnough(format!(
        "{}: {rests} static interval{}, at least {FEWEST_RESTS} needed to tell a missing effect from a scale factor: hold the \
         device still for 5 s in twenty orientations or more, each face up and down among them",
        names(session),
        if rests == 1 { "" } else { "s" }
    )))
}

/// Refuses a session that leaves nothing to compare once the base models are fitted.
///
/// # Errors
/// [`Error::NotEnough`].
pub fn enough_to_compare(session: &Session<'_>, base: &State) -> Result<(), Error> {
    if base.projected.dof() > 0 {
        return Ok(());
    }
    Err(Error::NotEnough(format!(
        "{}: the base models use up all {} readings: nothing is left that an effect could show in; record more \
         orientations",
        names(session),
        base.rows()
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
