//! The page of a calibration that could not be made: why, what to do, and what there is.

use ::findings::Front;
use calib::Recording;
use calib::intervals::Segmentation;
use nalgebra::Vector3;
use plan::REQUIREMENT;

use super::calibration::covered;
use super::coverage::{self, Coverage};
use super::residual::Residual;
use super::session::Session;
use super::{noise, provenance, residuals, verdict};
use crate::exit::{Failure, NOT_ENOUGH};
use crate::report::{Figure, Level, Picture, Report, numbered};
use crate::show;

/// Page and pictures of a refusal; recordings that could be cut are drawn.
pub fn page(
    failure: &Failure,
    recordings: &[Recording],
    cut: &[(&Recording, Segmentation)],
    gravity: f64,
) -> (Report, Vec<(String, Picture)>) {
    let pairs = cut.iter().map(|(r, segmentation)| (*r, segmentation));
    let session = Session::of(pairs, None, gravity).ok();
    let lacking = session.as_ref().and_then(|s| too_few(failure, s));
    let why = lacking.as_ref().map_or_else(
        || format!("{}.", failure.message.trim_end_matches('.')),
        few_in_words,
    );
    let mut report = Report::new("No calibration")
        .verdict(Level::Refused, format!("There is no calibration: {why}"))
        .provenance(provenance::of_recordings(recordings));
    let mut next = lacking.as_ref().map_or(Vec::new(), placements_to_add);
    let mut warnings: Vec<String> = lacking.iter().map(|_| failure.message.clone()).collect();
    warnings.extend(
        recordings
            .iter()
            .flat_map(|r| r.warnings.texts(Front::CommandLine)),
    );
    warnings = show::folded(&warnings);
    let Some(session) = session.filter(|s| !s.parts.is_empty()) else {
        next.extend(failure.advice.as_deref().map(verdict::sentence));
        if next.is_empty() {
            next.push("See what is in the file: stillpoint info RECORDING".into());
        }
        return (report.next(&next).warnings(&warnings), Vec::new());
    };
    let coverage = covered(&session);
    if next.is_empty() {
        next.extend(coverage.as_ref().and_then(Coverage::advice));
    }
    if next.is_empty() {
        next.extend(failure.advice.as_deref().map(verdict::sentence));
    }
    if lacking.is_none() {
        next.push(format!(
            "Leave the device still for {:.0} s in each placement, and turn it at {:.0} °/s at most between them.",
            REQUIREMENT.rest, REQUIREMENT.fastest
        ));
    }
    next.push(format!(
        "Then calibrate both recordings together: {}",
        verdict::TOGETHER
    ));
    let turns = session.turns.iter().filter(|t| t.fault.is_none()).count();
    let mut figures = vec![Figure::new(
        "Found",
        show::counted(session.rests.len(), "static interval"),
        format!("and {} between them", show::counted(turns, "turn")),
    )];
    figures.extend(coverage.as_ref().map(Coverage::figure));
    figures.push(Residual::measured(&session).figure());
    report = report.figures(figures).next(&next).warnings(&warnings);
    let mut pictures: Vec<(String, Picture)> = Vec::new();
    if let Some(coverage) = &coverage {
        pictures.push(("coverage".into(), coverage::picture(&session, coverage)));
    }
    pictures.push(("modulus".into(), residuals::norm(&session, None).into()));
    let units = units(&session, gravity);
    pictures.extend(numbered("rests", residuals::over_time(&session, units)));
    pictures.extend(numbered("noise", noise::pictures(&session, units)));
    report = report.section("What there is");
    report = pictures
        .iter()
        .fold(report, |report, (_, picture)| report.plot(picture));
    (report.table(session.table()), pictures)
}

/// Readings that come to gravity at rest are m/s², and those that carry its direction through the turns rad/s; of others the
/// unit is not known.
fn units(session: &Session<'_>, gravity: f64) -> [&'static str; 2] {
    let all =
        |values: Vec<f64>, most: f64| !values.is_empty() && values.iter().all(|v| v.abs() < most);
    let norms = session.rests.iter().filter_map(|rest| rest.raw).collect();
    let mut angles: Vec<f64> = session.turns.iter().filter_map(|turn| turn.raw).collect();
    angles.sort_by(f64::total_cmp);
    angles.truncate(angles.len().div_ceil(2));
    [
        if all(norms, 1e3 * NEAR_GRAVITY * gravity) {
            "m/s²"
        } else {
            "reading"
        },
        if all(angles, NEAR_DIRECTION) {
            "rad/s"
        } else {
            "reading"
        },
    ]
}

/// Largest deviation of raw norms from gravity (relative), and of raw directions from the predicted ones (°), for half
/// of the turns.
const NEAR_GRAVITY: f64 = 0.5;
const NEAR_DIRECTION: f64 = 20.0;

/// Placements named one by one; the picture and the warnings have all.
const NAMED: usize = 6;
/// Placements that are asked for where only the noise is too large, as the message does.
const MORE: usize = 2;

/// Returns the missing placements, if too few placements are the reason of the refusal.
fn too_few(failure: &Failure, session: &Session<'_>) -> Option<plan::Coverage> {
    let ups: Vec<Vector3<f64>> = session
        .directions()
        .into_iter()
        .map(Vector3::from)
        .collect();
    let short = !plan::coverage(&ups).is_complete() || ups.len() < REQUIREMENT.placements;
    (failure.code == NOT_ENOUGH && !ups.is_empty() && short)
        .then(|| plan::coverage(&ups).or_more(MORE))
}

/// `6 placements are too few, at least 10 are needed; no placement has z up.`
fn few_in_words(found: &plan::Coverage) -> String {
    let (count, least) = (found.covered.len(), REQUIREMENT.placements);
    let there = if count < least {
        format!("too few placements, {count} where at least {least} are needed")
    } else {
        format!("too few different placements, {}", found.found())
    };
    let missing = found.missing();
    let and = if missing.is_empty() { "" } else { "; " };
    format!("{there}{and}{missing}.")
}

/// Returns the number of placements to add, and a sentence for each.
fn placements_to_add(found: &plan::Coverage) -> Vec<String> {
    let wanted = found.wanted.iter().take(NAMED);
    let each = wanted.map(|w| format!("Add a placement with {} (a phone: {}).", w.axes, w.words));
    let more = show::counted(found.wanted.len(), "more placement");
    let mut all = vec![format!(
        "Make a second recording with {more}: leave the device still for {:.0} s in each, leant on something where it is \
         tilted, and turn it slowly between them, a quarter turn in a second.",
        REQUIREMENT.rest
    )];
    all.extend(each);
    let more = found.wanted.len().saturating_sub(NAMED);
    if more > 0 {
        all.push(format!("Add {more} more: the warning names them."));
    }
    all
}
