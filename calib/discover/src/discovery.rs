//! The whole way from recordings to findings.
//!
//! ```text
//! Session ──► base ──► judged: names, remainder ──► settle ──► proposed ──► calibrated ──► assembled
//!               │         search and what it takes back          formula     what is determined   findings.json
//!               └──► integrity: a recording that is spoilt is looked at no further
//! ```

use std::borrow::Borrow;

use ::findings::Finding;
use estimate::calibrate::own_effects;
use recording::{Error, Recording};
use sensor::EffectRef;

use super::base::base;
use super::calibrated::{calibrated, calibration, calibration_that, settle, with_magnetometer};
use super::fault::delay::{Delay, delay};
use super::fault::integrity::{Integrity, SPOILT, disturbed, integrity};
use super::fault::undersampled::undersampled;
use super::findings::Findings;
use super::findings::assembled::Found;
use super::findings::late::{late, late_apart, late_finding};
use super::findings::latitude::instead_of_a_name;
use super::findings::named;
use super::findings::proposed::proposed;
use super::findings::room::described;
use super::judgement::{Judged, judged};
use super::request::{Request, Session};
use super::search::Search;
use super::state::State;

/// The chance that stamps which are late by the same in all recordings are said to be late by different times.
const LATE_APART: f64 = 1e-3;

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

/// The same in a session, which knows its clocks and whether its biases flicker afterwards.
pub(super) fn discover_in(session: &mut Session<'_>) -> Result<Discovery, Error> {
    let base = base(session)?;
    let mut faults = integrity(session, &base);
    let is_spoilt = faults.iter().any(|fault| SPOILT.contains(&&*fault.name));
    let Judged {
        mut search,
        rest,
        instead,
    } = match is_spoilt {
        true => Judged::nothing_looked_for(base),
        // A formula whose parameters these recordings do not determine takes no name's place.
        false => judged(session, base, |session, state| {
            calibration(session, state).is_ok()
        })?,
    };
    if let Some(latitude) = session.request.latitude
        && let Some((doubt, name)) = instead_of_a_name(&search.names, latitude)
    {
        let instead = doubt.finding().detail("instead", name);
        return at_latitude(doubt.shown(), instead, session);
    }
    let stamps = match is_spoilt {
        true => LateStamps::default(),
        false => LateStamps::of(session, &mut search)?,
    };
    let held = settle(session, &mut search.last);
    let formula = match &rest {
        Some(rest) => proposed(session, &mut search, rest, instead)?,
        None => None,
    };
    let (proposed, with_formula) = formula.unzip();
    let mut calibration = calibrated(session, &mut search, held)?;
    let mut effects = named::findings(&search, &calibration, &session.request);
    let (rest, is_of_a_room) = described(&mut effects, &mut search, rest);
    if is_of_a_room {
        let warnings = std::mem::take(&mut calibration.warnings);
        calibration = calibration_that(true, session, &search.last)?;
        calibration.warnings = warnings;
    }
    calibration = with_magnetometer(session, calibration)?;
    if let Some((effect, late)) = stamps.together {
        let again = delay(&search.last);
        let late = late_finding(&effect, &late, again, &session.request, &mut calibration);
        effects.push(late);
    }
    let lasting = disturbed(&search.last, &faults, &search.either);
    faults.extend(lasting);
    faults.extend(stamps.apart);
    faults.extend(undersampled(&search.last));
    let found = Found {
        effects,
        faults,
        rest,
        proposed,
        calibration,
    };
    Ok(Discovery {
        findings: found.assembled(session, &search),
        search,
        with_formula,
    })
}

/// The same at the latitude that the recordings show, with the doubt about the one that was given.
fn at_latitude(shown: f64, doubt: Finding, session: &mut Session<'_>) -> Result<Discovery, Error> {
    session.request.latitude = Some(shown);
    session.base = None;
    let mut discovery = discover_in(session)?;
    discovery.findings.calibration.warnings.push(doubt);
    Ok(discovery)
}

/// Stamps that are late, as the moving accelerometer shows.
#[derive(Default)]
struct LateStamps {
    /// By the same in all recordings.
    together: Option<(EffectRef, Delay)>,
    /// In each recording by its own.
    apart: Vec<Integrity>,
}

impl LateStamps {
    /// Those of the final model, which holds what is late by the same afterwards.
    fn of(session: &Session<'_>, search: &mut Search) -> Result<Self, Error> {
        let apart = late_apart(&search.last, &session.request, LATE_APART);
        let looks = apart.is_empty();
        let together = looks
            .then(|| late(&search.last, &session.request))
            .flatten();
        if let Some((effect, late)) = &together {
            let mut extension = search.last.extension.clone();
            extension
                .effects
                .push((effect.clone(), Some((0, late.delay))));
            search.last = search.fit(session, extension)?;
        }
        Ok(Self { together, apart })
    }
}
