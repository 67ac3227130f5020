//! The page of a calibration.

use ::findings::Front;
use calib::Calibration;
use calib::calibration::Triad;
use sensor::Sensor;

use super::coverage::{self, Coverage};
use super::session::Session;
use super::{noise, parameters, provenance, quantiles, residuals, verdict};
use crate::commands::calibrate::field::field_unit;
use crate::commands::calibrate::tables::{
    PARAMETERS, coefficients, field, over_noise, parameters as rows,
};
use crate::commands::calibrate::{left_out, limits};
use crate::exit::Failure;
use crate::report::{Picture, Report, ReportTable, numbered};
use crate::show;

/// Pictures that every calibration may have, as files are called.
const NAMES: [&str; 9] = [
    "modulus",
    "direction",
    "coverage",
    "parameters",
    "correlation",
    "noise-1",
    "noise-2",
    "quantiles-1",
    "quantiles-2",
];

/// Names of the plots of `recordings` recordings, as files are called.
pub fn plot_names(recordings: usize) -> Vec<String> {
    let cuts = (1..=recordings).map(|k| format!("rests-{k}"));
    let against = (1..=4).map(|k| format!("against-{k}"));
    let names = NAMES.map(str::to_owned).into_iter();
    names.chain(against).chain(cuts).collect()
}

/// The pictures with their names.
pub fn pictures(
    calibration: &Calibration,
    session: &Session<'_>,
    units: [&str; 2],
) -> Vec<(String, Picture)> {
    let measured = residuals::noise(calibration);
    let mut all: Vec<(String, Picture)> = vec![
        (
            "modulus".into(),
            residuals::norm(session, measured[0]).into(),
        ),
        (
            "direction".into(),
            residuals::direction(session, measured[1]).into(),
        ),
    ];
    all.retain(|(_, picture)| !matches!(picture, Picture::Plot(plot) if plot.is_empty()));
    if let Some(coverage) = covered(session) {
        all.push(("coverage".into(), coverage::picture(session, &coverage)));
    }
    all.push(("parameters".into(), parameters::forest(calibration)));
    all.extend(parameters::correlation(calibration).map(|p| ("correlation".into(), p)));
    all.extend(numbered("against", residuals::against(session, measured)));
    all.extend(numbered(
        "quantiles",
        quantiles::pictures(session, measured),
    ));
    all.extend(numbered("noise", noise::pictures(session, units)));
    all.extend(numbered("rests", residuals::over_time(session, units)));
    all
}

/// Returns the coverage by the placements; `None` without an accelerometer.
pub fn covered(session: &Session<'_>) -> Option<Coverage> {
    let directions = session.directions();
    (!directions.is_empty()).then(|| Coverage::of(&directions))
}

/// The page.
///
/// # Errors
/// What the calibration cannot be exported to.
pub fn page(
    calibration: &Calibration,
    session: &Session<'_>,
    pictures: &[(String, Picture)],
    units: [&str; 2],
) -> Result<Report, Failure> {
    let coverage = covered(session);
    let judged = verdict::judged(calibration, coverage.as_ref());
    let mut report = Report::new(format!("Calibration from {}", names(session)))
        .verdict(judged.level, &judged.sentence)
        .figures(verdict::figures(calibration, session, coverage.as_ref()))
        .next(&judged.next)
        .limits(limits::shown(&calibration.limits))
        .warnings(&notes(calibration))
        .provenance(provenance::rows(calibration));
    let drawn = |report: Report, wanted: &[&str]| {
        let is_wanted = |name: &str| wanted.iter().any(|w| name.starts_with(w));
        let all = pictures.iter().filter(|(name, _)| is_wanted(name));
        all.fold(report, |report, (_, picture)| report.plot(picture))
    };
    report = drawn(report.section("What is left"), &["modulus", "direction"]);
    report = report.text(
        "Each point is a static interval or a turn; bars are two standard errors of its mean. The rate left in the two static \
         intervals beside a turn is taken off as bias.",
    );
    report = drawn(
        report.section("Placements and parameters"),
        &["coverage", "parameters"],
    );
    for (kind, heading, unit) in [
        (
            Sensor::Accelerometer,
            "Accelerometer, a = T (A − b)",
            units[0],
        ),
        (Sensor::Gyroscope, "Gyroscope, w = T (W − b)", units[1]),
        (
            Sensor::Magnetometer,
            "Magnetometer, m = T (M − b)",
            field_unit(calibration),
        ),
    ] {
        if let Some(triad) = calibration.triad(kind) {
            report = sensor(report, heading, triad, unit, kind);
        }
    }
    if calibration.magnetic_field.is_some() {
        report = report.text(field(calibration).trim_end());
    }
    report = effects(report, calibration);
    report = left_out(report, calibration, units);
    report = drawn(
        report.section("What the misfit goes with"),
        &["against", "quantiles"],
    );
    report = drawn(
        report.section("Noise and correlations"),
        &["noise", "correlation"],
    );
    report = drawn(report.section("Static intervals and turns"), &["rests"]);
    if !session.rests.is_empty() {
        report = report
            .text("Raw and left are the norm of specific force less gravity, and the error of gravity's direction after a turn.")
            .table(session.table());
    }
    exports(report, calibration)
}

/// Gates and limits first, then warnings.
pub fn notes(calibration: &Calibration) -> Vec<String> {
    let failed = limits::reasons(calibration).into_iter();
    let mut notes: Vec<String> = failed.map(|gate| format!("Do not use: {gate}")).collect();
    notes.extend(calibration.warnings.texts(Front::CommandLine));
    show::folded(&notes)
}

fn names(session: &Session<'_>) -> String {
    match session.parts.as_slice() {
        [] => "static means".into(),
        [one] => format!("the recording “{}”", one.name),
        many => format!("{} recordings", many.len()),
    }
}

fn sensor(report: Report, heading: &str, triad: &Triad, unit: &str, kind: Sensor) -> Report {
    let table = ReportTable::of(PARAMETERS, rows(triad, unit, kind));
    let mut report = report.folded(heading).table(table).text(format!(
        "Condition {:.1}, rank {}{}.",
        triad.condition,
        triad.rank,
        over_noise(triad)
    ));
    for what in &triad.unobservable {
        report = report.text(format!("Not observable: {what}"));
    }
    report
}

fn effects(mut report: Report, calibration: &Calibration) -> Report {
    for effect in &calibration.effects {
        let table = ReportTable::of(PARAMETERS, coefficients(effect));
        report = report.section(effect.name.clone()).table(table);
    }
    report
}

fn left_out(report: Report, calibration: &Calibration, units: [&str; 2]) -> Report {
    let rows = left_out::rows(calibration, units);
    if rows.is_empty() {
        return report;
    }
    let table = ReportTable::of(left_out::HEADER, rows);
    let heading = "What the standard errors take for granted";
    report.folded(heading).text(left_out::SENTENCE).table(table)
}

/// The calibration to be copied: as C, where that can hold it, and as JSON without the covariance.
pub fn exports(report: Report, calibration: &Calibration) -> Result<Report, Failure> {
    let mut report = report;
    let settings = exchange::Settings::default();
    if let Some(target) = exchange::by_name("c") {
        let source = exchange::Source::new(calibration);
        if let Ok(written) = exchange::export(target, &source, &settings) {
            for file in written.files.iter().take(1) {
                report = report.export("C", String::from_utf8_lossy(file));
            }
        }
    }
    let mut small = calibration.clone();
    small.covariance.clear();
    small.parameters.clear();
    // Beside the errors only it says something.
    small.left_out.clear();
    small.seal_again(calibration);
    let json = show::json(&small)?;
    // What is copied needs no indentation.
    let lines: Vec<&str> = json.lines().map(str::trim_start).collect();
    Ok(report.export("JSON, without the covariance", lines.join("\n")))
}
