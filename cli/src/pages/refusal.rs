//! The page of a calibration that could not be made: why, what to do, and what there is.

use calib::Recording;
use calib::intervals::Segmentation;

use super::calibration::covered;
use super::session::Session;
use super::{coverage, noise, provenance, residuals, verdict};
use crate::exit::Failure;
use crate::report::{Figure, Level, Picture, Report};
use crate::show;

/// Page and pictures of a refusal; recordings that could be cut are drawn.
pub fn page(
    failure: &Failure,
    recordings: &[Recording],
    cut: &[(&Recording, &Segmentation)],
    gravity: f64,
) -> (Report, Vec<(String, Picture)>) {
    let (why, more) = in_short(&failure.message);
    let mut report = Report::new("No calibration")
        .verdict(Level::Bad, format!("There is no calibration: {why}."))
        .provenance(provenance::of_recordings(recordings));
    let mut next = Vec::new();
    let mut warnings: Vec<String> = more.into_iter().collect();
    warnings.extend(recordings.iter().flat_map(|r| r.warnings.clone()));
    warnings = show::folded(&warnings);
    let session = Session::of(cut.iter().copied(), None, gravity).ok();
    let Some(session) = session.filter(|s| !s.parts.is_empty()) else {
        next.extend(verdict::advice_in(&failure.message));
        if next.is_empty() {
            next.push("See what is in the file: stillpoint info RECORDING".into());
        }
        return (report.next(&next).warnings(&warnings), Vec::new());
    };
    let coverage = covered(&session);
    next.extend(coverage.as_ref().and_then(coverage::Coverage::advice));
    if next.is_empty() {
        next.extend(verdict::advice_in(&failure.message));
    }
    next.push(
        "Hold the device still for three seconds in each placement and turn it briskly between them; then calibrate the new \
         recording, or both together."
            .into(),
    );
    let turns = session.turns.iter().filter(|t| t.fault.is_none()).count();
    let mut figures = vec![Figure::new(
        "Found",
        format!("{} static intervals", session.rests.len()),
        format!("and {turns} turns between them"),
    )];
    figures.extend(
        coverage
            .as_ref()
            .map(|c| Figure::new("Directions covered", c.value(), c.note())),
    );
    figures.push(verdict::residual(&session));
    report = report.figures(figures).next(&next).warnings(&warnings);
    let mut pictures: Vec<(String, Picture)> = Vec::new();
    if let Some(coverage) = &coverage {
        pictures.push(("coverage".into(), coverage::picture(&session, coverage)));
    }
    pictures.push(("modulus".into(), residuals::norm(&session, None).into()));
    let units = ["reading", "reading"];
    let named = |name: &'static str, all: Vec<Picture>| {
        let all = all.into_iter().enumerate();
        all.map(move |(k, p)| (format!("{name}-{}", k + 1), p))
    };
    pictures.extend(named("rests", residuals::over_time(&session, units)));
    pictures.extend(named("noise", noise::pictures(&session, units)));
    report = report.section("What there is");
    report = pictures
        .iter()
        .fold(report, |report, (_, picture)| report.plot(picture));
    (report.table(session.table()), pictures)
}

/// The message up to what only an expert reads, and the whole of it where something was cut off.
fn in_short(message: &str) -> (&str, Option<String>) {
    let message = message.trim_end_matches('.');
    match message.find("; not observable") {
        Some(end) => (&message[..end], Some(message.to_owned())),
        None => (message, None),
    }
}
