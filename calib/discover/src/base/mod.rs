//! The base models, fitted to recordings that are enough and of one device.

mod enough;

use std::sync::Arc;

use enough::{enough_rests, enough_to_compare};
use estimate::calibrate::{
    gyroscope_of_one_device, not_in_one_plane, of_one_device, of_one_recording_each,
    readings_of_the_device, refuse_unobservable,
};
use estimate::methods::static_means;
use findings::Finding;
use recording::Error;

use super::extension::Extension;
use super::request::Session;
use super::state::State;

/// The base models; the session knows its clocks and the fit afterwards.
///
/// # Errors
/// Too few rests, rests in one plane, parameters that they do not determine, recordings of different devices, and those of the joint fit.
pub(super) fn base(session: &mut Session<'_>) -> Result<State, Error> {
    enough_rests(session)?;
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
        let differ = of_one_device(&session.ready(), &means, session.request.gravity)?;
        // At another latitude once more.
        let is_new = |found: &Finding| session.remarks.iter().all(|own| own.kind != found.kind);
        let differ = differ.filter(is_new);
        session.remarks.extend(differ);
    }
    let base = State::fit(session, Extension::default())?;
    session.clocks = Some(base.fit.data.decided_clocks());
    session.base = Some(Arc::clone(&base.fit));
    refuse_unobservable(&base.fit)?;
    enough_to_compare(session, &base)?;
    if !session.request.force_device {
        gyroscope_of_one_device(&base.fit, &session.ready(), false)?;
    }
    Ok(base)
}
