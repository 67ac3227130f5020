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

use estimate::calibrate::own_effects;
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
use super::request::{Request, Session};
use super::search::Search;
use super::search::samples::other_samples;
use super::state::State;

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
        let base = base(session)?;
        let faults = integrity(session, &base);
        let explained = match faults.iter().any(Integrity::spoils) {
            true => Explained::of(Search::of(base)),
            false => explained(session, base)?,
        };
        if let Some((doubt, name)) = &explained.latitude {
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
            break (faults, explained);
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
