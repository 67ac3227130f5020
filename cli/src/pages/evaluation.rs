//! The page of an evaluation: calibrations side by side on a recording that they have not seen.

use ::findings::{Finding, Front, Kind};
use calib::calibrate::STANDARD_GRAVITY;
use calib::intervals::Segmentation;
use calib::methods::online_bias::LONG_ENOUGH;
use calib::{Calibration, Evaluation, Recording};

use super::calibration::covered;
use super::coverage::{self, Coverage};
use super::residual::Residual;
use super::session::Session;
use super::verdict::Judged;
use super::{noise, provenance, residuals};
use crate::report::{
    Axis, Figure, Level, Limit, Picture, Plot, Report, ReportTable, Series, numbered,
};
use crate::show;

/// A calibration must leave less than this share of the raw misfit to be of use.
const OF_USE: f64 = 0.9;

/// A rate at rest that is no rotation of the earth, rad/s: twice that.
const FAR_FROM_ZERO: f64 = 1.5e-4;

/// The step after an evaluation.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// A calibration is named.
    NameCalibration,
    /// The device is recorded at rest.
    RecordAtRest,
    /// A calibration of this recording is made and compared.
    CalibrateThis,
    /// The calibration of this place is used.
    Use(usize),
    /// The biases of the calibration of this place are estimated again.
    EstimateBias(usize),
    /// The advice of a finding.
    Advice(String),
}

/// Advice where nothing could be compared.
pub const RECORD_AT_REST: &str = "Record again and hold the device still now and then.";

/// Advice where a calibration is of no use.
pub const CALIBRATE_THIS: &str = "Check that recording and calibration are of one device and one unit, then calibrate on this recording and compare.";

/// A calibration by its name, with what it leaves.
pub type Named<'a> = (&'a str, &'a Calibration);

/// Page and pictures; `rows`, and the `gravities` they are compared with, are of the raw readings and then of every
/// calibration.
///
/// # Errors
/// As [`Session::of`].
pub fn page(
    recording: &Recording,
    segmentation: &Segmentation,
    calibrations: &[Named<'_>],
    rows: &[(String, Evaluation)],
    (header, cells): (&[&str], &[Vec<String>]),
    gravities: &[f64],
    head: Head<'_>,
) -> Result<(Report, Vec<(String, Picture)>), calib::Error> {
    let cut = || std::iter::once((recording, segmentation));
    let mut sessions = Vec::new();
    let of_raw = gravities.first().copied().unwrap_or(STANDARD_GRAVITY);
    let own = |k: usize| gravities.get(k + 1).copied().unwrap_or(of_raw);
    for (k, (name, calibration)) in calibrations.iter().enumerate() {
        sessions.push((*name, Session::of(cut(), Some(calibration), own(k))?));
    }
    let raw = Session::of(cut(), None, of_raw)?;
    let first = sessions.first().map_or(&raw, |(_, session)| session);
    let coverage = covered(first);
    let mut figures = vec![Residual::measured(first).figure()];
    figures.push(bias(rows));
    figures.extend(coverage.as_ref().map(Coverage::figure));
    let table = ReportTable::of(header.iter().copied(), cells.iter().cloned());
    let mut pictures: Vec<(String, Picture)> = Vec::new();
    let norm = compared(
        &raw,
        &sessions,
        "Norm of specific force less gravity",
        "mm/s²",
        |s| {
            let rests = s.rests.iter();
            rests.map(|r| (r.key.clone(), r.raw, r.left)).collect()
        },
    );
    let direction = compared(
        &raw,
        &sessions,
        "Error of gravity's direction after each turn",
        "°",
        |s| {
            let turns = s.turns.iter();
            turns.map(|t| (t.key.clone(), t.raw, t.left)).collect()
        },
    );
    pictures.push(("norm".into(), norm.into()));
    pictures.push(("direction".into(), direction.into()));
    pictures.retain(|(_, p)| !matches!(p, Picture::Plot(plot) if plot.is_empty()));
    if let Some(coverage) = &coverage {
        pictures.push(("coverage".into(), coverage::picture(first, coverage)));
    }
    let units = ["m/s²", "rad/s"];
    let against = residuals::against(first, [None, None]);
    pictures.extend(numbered("against", against));
    pictures.extend(
        residuals::over_time(first, units)
            .into_iter()
            .map(|p| ("intervals".into(), p)),
    );
    pictures.extend(numbered("noise", noise::pictures(first, units)));
    let mut report = Report::new(format!("Evaluation on {}", show::name(&recording.name)))
        .verdict(head.judged.level, head.judged.sentence)
        .figures(figures)
        .next(&head.judged.next)
        .limits(head.limits)
        .warnings(&show::folded(head.warnings))
        .section("Side by side")
        .table(table)
        .section("What is left");
    report = pictures
        .iter()
        .fold(report, |report, (_, picture)| report.plot(picture));
    report = report.table(first.table());
    let mut rows = provenance::of_recordings(std::slice::from_ref(recording));
    rows.push(["gravity".into(), format!("{of_raw} m/s²")]);
    for (k, (name, calibration)) in calibrations.iter().enumerate() {
        let made = match own(k) {
            gravity if gravity == of_raw => {
                format!("{}, by {}", calibration.method, calibration.created_by)
            }
            gravity => format!(
                "{}, by {}, gravity {gravity} m/s²",
                calibration.method, calibration.created_by
            ),
        };
        rows.push([format!("calibration {}", show::name(name)), made]);
    }
    Ok((report.provenance(rows), pictures))
}

/// Names of the pictures, as files are called.
pub const PLOTS: [&str; 10] = [
    "norm",
    "direction",
    "coverage",
    "against-1",
    "against-2",
    "against-3",
    "against-4",
    "intervals",
    "noise-1",
    "noise-2",
];

/// The head of a page.
#[derive(Debug)]
pub struct Head<'a> {
    /// The verdict and what comes next.
    pub judged: Judged,
    /// Limits that were asked.
    pub limits: Vec<Limit>,
    /// Warnings.
    pub warnings: &'a [String],
}

/// The best calibration against the raw readings, and what speaks against it; `doubts` and `failed`, the limits that it does not keep in words,
/// are those of each calibration.
pub fn judged(
    rows: &[(String, Evaluation)],
    (doubts, failed): (&[Vec<Finding>], &[Option<String>]),
    (segmentation, warnings): (&Segmentation, &[String]),
) -> (Level, String, Vec<Next>) {
    let Some((raw, calibrated)) = rows.split_first().filter(|(_, rest)| !rest.is_empty()) else {
        let what = "Only the raw readings were measured: no calibration was named.";
        return (Level::Care, what.into(), vec![Next::NameCalibration]);
    };
    let share = |e: &Evaluation| {
        let of = |left: Option<f64>, raw: Option<f64>| Some(left? / raw?);
        let norm = of(e.modulus_rms, raw.1.modulus_rms);
        let direction = of(e.direction_rms, raw.1.direction_rms);
        let all: Vec<f64> = norm.into_iter().chain(direction).collect();
        all.iter().sum::<f64>() / all.len().max(1) as f64
    };
    let best = (0..calibrated.len())
        .min_by(|&a, &b| share(&calibrated[a].1).total_cmp(&share(&calibrated[b].1)));
    let Some((best, (name, e))) = best.map(|k| (k, &calibrated[k])) else {
        return (Level::Care, "Nothing could be compared.".into(), Vec::new());
    };
    let part = |what: &str, left: Option<f64>, raw: Option<f64>, factor: f64, unit: &str| {
        let (left, raw) = (left?, raw?);
        Some(format!(
            "to {:.2}{unit} {what} (raw {:.2})",
            factor * left,
            factor * raw
        ))
    };
    let parts: Vec<String> = [
        part("at rest", e.modulus_rms, raw.1.modulus_rms, 1e3, " mm/s²"),
        part(
            "after a turn",
            e.direction_rms,
            raw.1.direction_rms,
            1.0,
            "°",
        ),
    ]
    .into_iter()
    .flatten()
    .collect();
    if parts.is_empty() {
        let what = "Nothing could be compared: the device is at rest nowhere in this recording.";
        return (Level::Care, what.into(), vec![Next::RecordAtRest]);
    }
    let name = show::name(name);
    let sentence = format!(
        "With {name} this recording meets gravity {}.",
        parts.join(" and ")
    );
    if share(e) > OF_USE {
        let bad = format!("{name} is no better than the raw readings. {sentence}");
        return (Level::Bad, bad, vec![Next::CalibrateThis]);
    }
    if let Some(Some(failed)) = failed.get(best) {
        let bad = format!("Not to be used: {name} fails {failed}. {sentence}");
        return (Level::Bad, bad, Vec::new());
    }
    // What is doubted is neither used nor given another bias.
    if let Some((why, advice)) = doubts.get(best).and_then(|own| doubted(own)) {
        let next = advice.map(Next::Advice);
        let sentence = format!("{sentence} {why}");
        return (Level::Care, sentence, next.into_iter().collect());
    }
    let mut own = doubts.get(best).into_iter().flatten();
    let has_moved = own.any(|found| found.kind == Kind::RATE_AT_REST_OFF);
    let mut rests = segmentation.statics.iter();
    let can_renew =
        norm(e.static_rate) > FAR_FROM_ZERO && rests.any(|rest| rest.span.length() > LONG_ENOUGH);
    let mut next = Vec::new();
    if !has_moved {
        next.push(Next::Use(best));
    }
    if can_renew {
        next.push(Next::EstimateBias(best));
    }
    if next.is_empty() {
        next.push(Next::RecordAtRest);
    }
    let level = if warnings.is_empty() {
        Level::Good
    } else {
        Level::Care
    };
    (level, sentence, next)
}

/// The doubt about a calibration on a recording that says most, and what it advises.
pub fn doubted(doubts: &[Finding]) -> Option<(&'static str, Option<String>)> {
    let found = doubts.iter().find(|found| {
        matches!(
            found.kind,
            Kind::DIRECTION_OFF | Kind::FIELD_OFF | Kind::NORM_GROWN | Kind::NORM_OFF
        )
    })?;
    let why = match found.kind {
        Kind::FIELD_OFF => "The corrected magnetic field is another in each placement.",
        Kind::NORM_GROWN => "In its own recordings it left far less: the sensor has changed since.",
        _ => "The recording may be of another device.",
    };
    let advice = found.advice(Front::CommandLine);
    Some((why, advice.map(|advice| show::capital(&advice) + ".")))
}

/// Size of a mean rate at rest; 0 where none is known.
fn norm(rate: Option<[f64; 3]>) -> f64 {
    let square: f64 = rate.iter().flatten().map(|v| v * v).sum();
    square.sqrt()
}

/// Builds the figure of the gyroscope's bias error with the first calibration, °/s.
fn bias(rows: &[(String, Evaluation)]) -> Figure {
    let rate = rows
        .get(1)
        .or(rows.first())
        .and_then(|(_, e)| e.static_rate);
    let value = rate.map_or("none".into(), |rate| {
        format!("{:.4} °/s", norm(Some(rate)).to_degrees())
    });
    Figure::new("Rate at rest", value, "what the gyroscope's bias is off by")
}

/// Key, raw reading and what is left of it.
type Pair = (String, Option<f64>, Option<f64>);

/// A panel of raw readings and one of every calibration.
fn compared(
    raw: &Session<'_>,
    sessions: &[(&str, Session<'_>)],
    title: &str,
    unit: &str,
    of: fn(&Session<'_>) -> Vec<Pair>,
) -> Plot {
    let number = |key: &str| key.trim_start_matches('t').parse::<f64>().unwrap_or(0.0);
    let series = |session: &Session<'_>, name: &str, colour: usize, raw: bool| {
        let (mut dots, mut keys) = (Vec::new(), Vec::new());
        for (key, before, after) in of(session) {
            if let Some(value) = if raw { before } else { after } {
                dots.push((number(&key), value));
                keys.push(key);
            }
        }
        Series::dots(name, colour, dots).of(keys)
    };
    let plot = Plot::new(
        title,
        Axis::linear("static interval or turn"),
        Axis::linear(format!("raw, {unit}")),
    )
    .with(series(raw, "raw", residuals::GREY, true));
    if sessions.is_empty() {
        return plot;
    }
    let plot = plot.panel(Axis::linear(format!("calibrated, {unit}")));
    let colours = [0, 1, 3, 4, 5];
    sessions
        .iter()
        .enumerate()
        .fold(plot, |plot, (k, (name, session))| {
            plot.with(series(session, &show::name(name), colours[k % 5], false))
        })
}
