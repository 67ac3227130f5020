//! The whole way from recordings to findings.
//!
//! ```text
//! Session ──► base ──► judged: names, remainder ──► settle ──► proposed ──► calibrated ──► assembled
//!               │         search and what it takes back          formula     what is determined   findings.json
//!               └──► integrity: a recording that is spoilt is looked at no further
//! ```

use std::borrow::Borrow;

use estimate::calibrate::own_effects;
use recording::{Error, Recording};

use super::base::base;
use super::calibrated::{calibrated, completed};
use super::fault::integrity::{SPOILT, disturbed, integrity};
use super::fault::undersampled::undersampled;
use super::findings::Findings;
use super::findings::assembled::Found;
use super::findings::late::LateStamps;
use super::findings::latitude::instead_of_a_name;
use super::findings::named;
use super::findings::room::described;
use super::names_and_remainder::{Judged, judged};
use super::request::{Request, Session};
use super::search::Search;
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
    let request = &request.granted(&recordings);
    let mut discovery = request
        .watch
        .over(|| discover_in(&mut Session::new(&recordings, request)?))?;
    let warnings = &mut discovery.findings.calibration.warnings;
    warnings.extend(own_effects::left_out(&request.catalogue));
    Ok(discovery)
}

/// Finds what the base models lack in a session, which knows its clocks, its latitude and whether its biases flicker afterwards.
pub(super) fn discover_in(session: &mut Session<'_>) -> Result<Discovery, Error> {
    let mut doubts = Vec::new();
    let (mut faults, is_spoilt, judged) = loop {
        let base = base(session)?;
        let faults = integrity(session, &base);
        let is_spoilt = faults.iter().any(|fault| SPOILT.contains(&&*fault.name));
        let judged = match is_spoilt {
            true => Judged::nothing_looked_for(base),
            false => judged(session, base)?,
        };
        let given = session.request.latitude;
        let doubt = given.and_then(|given| instead_of_a_name(&judged.search.names, given));
        let Some((doubt, name)) = doubt else {
            break (faults, is_spoilt, judged);
        };
        // Once more, at the latitude that the recordings show.
        doubts.push(doubt.finding().detail("instead", name));
        session.request.latitude = Some(doubt.shown());
        session.base = None;
    };
    let Judged {
        mut search,
        rest,
        instead,
        ..
    } = judged;
    let late = match is_spoilt {
        true => LateStamps::default(),
        false => LateStamps::of(session, &mut search)?,
    };
    let (formula, calibration) = calibrated(session, &mut search, rest.as_ref(), instead)?;
    let mut effects = named::findings(session, &search, &calibration);
    let (rest, is_of_a_room) = described(&mut effects, &mut search, rest);
    let mut calibration = completed(session, &search.last, calibration, is_of_a_room)?;
    effects.extend(late.finding(session, &search.last, &mut calibration));
    let lasting = disturbed(&search.last, &faults, &search.either);
    faults.extend(lasting);
    faults.extend(late.apart);
    faults.extend(undersampled(&search.last));
    let (proposed, with_formula) = formula.unzip();
    let found = Found {
        effects,
        faults,
        rest,
        proposed,
        calibration,
    };
    let mut findings = found.assembled(session, &search);
    findings
        .calibration
        .warnings
        .extend(doubts.into_iter().rev());
    Ok(Discovery {
        findings,
        search,
        with_formula,
    })
}
