//! The whole way from recordings to findings.
//!
//! ```text
//! Session ──► base ──► integrity ──► explained ──────────► calibrated ──────────► findings
//!             models    the readings   search and steps:     what is determined    findings.json
//!                       themselves     names, remainder,
//!                                      formula
//! ```
//!
//! A recording that is spoilt is looked at no further.

use std::borrow::Borrow;

use estimate::calibrate::{count_scale_changes, own_effects};
use estimate::methods::joint::SourceClock;
use recording::{Error, Recording};

use super::base::base;
use super::calibrated::{calibrated, completed};
use super::explained::{Explained, explained};
use super::fault::integrity::{Integrity, integrity};
use super::fault::of_the_fit::{disturbed, undersampled};
use super::findings::Findings;
use super::findings::assembled::Found;
use super::findings::named;
use super::findings::room::described;
use super::gap::channel::Channel;
use super::remainder::unexplained::Unexplained;
use super::request::{Request, Session};
use super::search::Search;
use super::search::samples::other_samples;
use super::state::State;

findings::tuning! {
    /// Log-likelihood from which on other samples are clearly better: those of ten sessions with a cubic gyroscope gained 44 to 112.
    CLEARLY: f64 = 10.0;

    /// Other latitudes that are tried: one mends what was given wrongly.
    LATITUDES: usize = 2;
}

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
    request.watch.over(|| {
        let mut session = Session::of(&recordings, request)?;
        let mut discovery = discover_in(&mut session)?;
        let left_out = own_effects::left_out(&session.request.catalogue);
        discovery.findings.calibration.warnings.extend(left_out);
        Ok(discovery)
    })
}

/// Finds what the base models lack in a session, which knows its clocks, its latitude and whether its biases flicker afterwards.
pub(super) fn discover_in(session: &mut Session<'_>) -> Result<Discovery, Error> {
    let mut doubts = Vec::new();
    let mut samples_are_known = false;
    let (mut faults, explained) = loop {
        let (faults, explained) = looked_at(session)?;
        if let Some((doubt, name)) = explained
            .latitude
            .as_ref()
            .filter(|_| doubts.len() < LATITUDES.get())
        {
            // Once more, at the latitude that the recordings show.
            doubts.push(doubt.finding().detail("instead", name.as_str()));
            session.request.latitude = Some(doubt.shown());
        } else if !samples_are_known
            && let Some(clocks) = other_samples(session, &explained.search.last)?
        {
            // Once more, with the samples for what they are.
            session.clocks = Some(clocks);
            samples_are_known = true;
        } else {
            break by_the_other_samples(session, (faults, explained))?;
        }
        session.base = None;
    };
    let mut search = explained.search;
    let calibration = calibrated(session, &mut search, explained.held)?;
    let mut effects = named::findings(session, &search, &calibration);
    let (rest, is_of_a_room) = described(&mut effects, &mut search, explained.rest);
    let mut calibration = completed(session, &search.last, calibration, is_of_a_room)?;
    let late = explained.late;
    effects.extend(late.finding(session, &search.last, &mut calibration));
    let lasting = disturbed(&search.last, &faults, &search.either);
    faults.extend(lasting);
    faults.extend(late.apart);
    count_scale_changes(&mut calibration, faults.iter().map(|own| &own.finding));
    faults.extend(undersampled(&search.last));
    let (proposed, with_formula) = explained.proposed.unzip();
    let found = Found {
        effects,
        faults,
        rest,
        proposed,
        calibration,
    };
    let mut findings = found.assembled(session, &search);
    let warnings = &mut findings.calibration.warnings;
    warnings.extend(doubts.into_iter().rev());
    Ok(Discovery {
        findings,
        search,
        with_formula,
    })
}

/// Faults of the recordings, and the explanations of their residuals.
type Seen = (Vec<Integrity>, Explained);

/// The faults of the recordings, and what the base models lack where nothing spoils them.
fn looked_at(session: &mut Session<'_>) -> Result<Seen, Error> {
    let base = base(session)?;
    let faults = integrity(session, &base);
    let explained = match faults.iter().any(Integrity::spoils) {
        true => Explained::of(Search::of(base)),
        false => explained(session, base)?,
    };
    Ok((faults, explained))
}

/// The same with samples at instants in place of means, or the other way round, where something stays unexplained in the turns and nothing
/// does so: what is missing in the model makes the turns miss, and may do so less with the wrong samples. It is a search more, so a long
/// recording and a search that was cut short have none.
fn by_the_other_samples(session: &mut Session<'_>, seen: Seen) -> Result<Seen, Error> {
    let in_turns = |rest: &Unexplained| rest.channel == Channel::Direction;
    let is_short = seen.1.search.spent.is_none() && !session.is_long();
    let may = is_short && seen.1.rest.as_ref().is_some_and(in_turns);
    let (true, Some(clocks)) = (may, &session.clocks) else {
        return Ok(seen);
    };
    let other = clocks.iter().map(|clock| SourceClock {
        instants: !clock.instants,
        ..*clock
    });
    let other = other.collect();
    let before = (session.clocks.replace(other), session.base.take());
    let flicker = session.request.flicker;
    let otherwise = looked_at(session);
    if matches!(otherwise, Err(Error::Cancelled)) {
        return otherwise;
    }
    let is_better = |(_, other): &Seen| {
        let likelier = other.search.last.log_likelihood() - seen.1.search.last.log_likelihood();
        other.rest.is_none() && other.latitude.is_none() && likelier > CLEARLY.get()
    };
    match otherwise {
        Ok(other) if is_better(&other) => Ok(other),
        _ => {
            (session.clocks, session.base) = before;
            session.request.flicker = flicker;
            Ok(seen)
        }
    }
}

#[cfg(test)]
mod tests {
    use simulate::{Grade, Motion, Sampling, Spec};

    use super::*;

    #[test]
    fn samples_that_were_taken_for_means_are_found_out_where_nothing_explains_the_turns() {
        let mut spec = Spec {
            rate: 50.0,
            grade: Grade::Tactical,
            sampling: Sampling::Point,
            ..Spec::hand_held(2)
        };
        if let Motion::HandHeld(motion) = &mut spec.motion {
            (motion.turn, motion.tremor) = ([1.0, 2.2], 0.0);
            motion.placements = Some(20);
        }
        let cubic = [("x", 6e-5), ("y", -6e-5), ("z", 4e-5)];
        let cubic = cubic.map(|(axis, size)| (axis.to_owned(), size));
        spec.effects.insert("gyro_cubic".into(), cubic.into());
        let recording = spec.run().unwrap().recording;
        let found = discover(&[recording], &Request::new(spec.gravity)).unwrap();
        assert!(found.search.last.fit.data.decided_clocks()[0].instants);
        let names: Vec<_> = found.findings.effects.iter().map(|e| &*e.name).collect();
        assert_eq!(names, ["gyro_cubic"]);
        assert!(found.findings.unexplained.is_none());
    }
}
