//! The static interval within which a bias stepped.
//!
//! A step is held between two static intervals. Where it happened within one, the mean of that interval is a mixture of before
//! and after: it looks disturbed, and pulls the estimate of the step towards itself.

use estimate::methods::joint::{DISTURBED_INTERVAL, Known, RATE_EXCURSION, Reason, Suspect};
use recording::Error;
use sensor::Sensor;

use crate::request::Session;
use crate::score::{log_tail, score};
use crate::search::Search;
use crate::state::State;

findings::tuning! {
    /// Chance of an interval beside a step that is off by so much where the step lies between intervals.
    BY_CHANCE: f64 = 0.01;
}

/// Leaves the interval beside a named step out of the fit where it is off: whether there is any.
///
/// # Errors
/// As the joint fit.
pub fn leave_out_mixed(session: &Session<'_>, search: &mut Search) -> Result<bool, Error> {
    let mut has_any = false;
    for _ in 0..search.last.extension.effects.len() {
        let Some(mixed) = mixed(&search.last) else {
            break;
        };
        let mut extension = search.last.extension.clone();
        extension.disturbed.push(mixed);
        search.last = search.fit(session, extension)?;
        has_any = true;
    }
    Ok(has_any)
}

/// Takes back what was left out for steps that have been withdrawn since: whether there is any.
///
/// # Errors
/// As the joint fit.
pub fn take_back(session: &Session<'_>, search: &mut Search) -> Result<bool, Error> {
    let beside = beside_steps(&search.last);
    let mut extension = search.last.extension.clone();
    let before = extension.disturbed.len();
    let stays = |known: &Known| known.reason != Reason::BiasStepped || beside.contains(known);
    extension.disturbed.retain(stays);
    let has_any = extension.disturbed.len() < before;
    if has_any {
        search.last = search.fit(session, extension)?;
    }
    Ok(has_any)
}

/// Gives the step as the reason of what the search found disturbed beside one that stands.
///
/// # Errors
/// As the joint fit.
pub fn explain_disturbed(session: &Session<'_>, search: &mut Search) -> Result<(), Error> {
    let beside = beside_steps(&search.last);
    let mut extension = search.last.extension.clone();
    for known in &mut extension.disturbed {
        if let Some(mixed) = beside.iter().find(|mixed| mixed.is_at(known)) {
            *known = *mixed;
        }
    }
    search.last = search.fit(session, extension)?;
    Ok(())
}

/// Lists the exclusions of the chunks just before and just after each bias step of a model.
fn beside_steps(state: &State) -> Vec<Known> {
    let mut all = Vec::new();
    for (effect, shape) in &state.extension.effects {
        let Some((_, t0)) = shape.filter(|(k, _)| effect.instant() == Some(*k)) else {
            continue;
        };
        let means = state.sensitivities.means.iter();
        let own = means.filter(|mean| mean.sensor == effect.sensor());
        let (before, after): (Vec<_>, Vec<_>) = own
            .map(|mean| (mean.truth.time, mean.chunk))
            .partition(|(time, _)| *time < t0);
        let nearest = [
            before.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)),
            after.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)),
        ];
        let chunks = nearest.into_iter().flatten().map(|(_, chunk)| chunk);
        all.extend(chunks.filter_map(|chunk| left_out(state, effect.sensor(), chunk)));
    }
    all
}

/// Builds the exclusion of one chunk of a sensor; `None` where it would exclude other chunks too.
fn left_out(state: &State, sensor: Sensor, chunk: usize) -> Option<Known> {
    if sensor == Sensor::Accelerometer {
        return Some(Known {
            fault: &DISTURBED_INTERVAL,
            place: chunk,
            reason: Reason::BiasStepped,
        });
    }
    let rest = state.fit.data.chunks[chunk].rest;
    let is_whole = state.fit.data.rests[rest].chunks.len() == 1;
    is_whole.then_some(Known {
        fault: &RATE_EXCURSION,
        place: rest,
        reason: Reason::BiasStepped,
    })
}

/// The interval beside a step that is off most, where that is hardly by chance.
fn mixed(state: &State) -> Option<Known> {
    let beside = beside_steps(state);
    if beside.is_empty() {
        return None;
    }
    let whitened = state.projected.at(state.noise)?;
    let log_p = |known: &Known| {
        let is_own = |s: &&Suspect| s.fault == known.fault && s.place == known.place;
        let suspect = state.suspects.iter().find(is_own)?;
        let columns = state.explained_by(suspect);
        let found = score(whitened.columns(&columns).as_ref(), &whitened.z);
        (found.dof > 0).then(|| log_tail(found.statistic, found.dof as f64))
    };
    let open = beside.into_iter();
    let open = open.filter(|known| !state.is_flagged(known.fault, known.place));
    let judged = open.filter_map(|known| Some((log_p(&known)?, known)));
    let off = judged.filter(|(log_p, _)| *log_p < BY_CHANCE.get().ln());
    off.min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, known)| known)
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use crate::{Request, discover};

    #[test]
    fn a_step_within_a_static_interval_is_no_disturbance_of_it() {
        let spec = Spec::hand_held(3).with_effect("accel_step", 3.0);
        let rests = spec.run().unwrap().truth.static_intervals;
        let middle = &rests[rests.len() / 2];
        let mut within = spec.clone();
        let own = within.effects.get_mut("accel_step").unwrap();
        own.insert("t0".into(), 0.5 * (middle.start + middle.end));
        let session = within.run().unwrap();
        let request = Request::new(spec.gravity);
        let findings = discover(&[session.recording], &request).unwrap().findings;
        assert!(findings.effects.iter().any(|e| e.name == "accel_step"));
        assert!(findings.integrity.is_empty(), "{:?}", findings.integrity);
        assert_eq!(findings.unexplained, None);
        let warnings = findings
            .calibration
            .warnings
            .texts(::findings::Front::CommandLine);
        assert!(
            warnings
                .iter()
                .any(|w| w.contains("jumps within this interval")),
            "{warnings:?}"
        );
        assert!(!warnings.iter().any(|w| w.contains("something touched")));
    }
}
