//! The report of a calibration: what was found, what it leaves, and where the device was still.

use calib::calibration::{RecordingBias, Triad};
use calib::intervals::Segmentation;
use calib::{Calibration, Misfit, Misfits, Recording, misfits};

use super::super::limits;
use super::super::rests_plot::rests_plot;
use super::tables::{self, PARAMETERS};
use crate::exit::Failure;
use crate::report::{Axis, Plot, Report, ReportTable, Series};
use crate::show;

/// Colour of what is not calibrated.
const GREY: usize = 6;

/// A recording, how it was cut, and what the calibration leaves of it.
#[derive(Debug)]
pub struct Part<'a> {
    recording: &'a Recording,
    segmentation: &'a Segmentation,
    /// Number of its first rest, counted through all recordings from 1.
    first: usize,
    left: Misfits,
    raw: Option<Misfits>,
}

impl Part<'_> {
    fn cut(&self) -> Plot {
        let units = match self.raw {
            Some(_) => ["m/s²", "rad/s"],
            None => ["counts"; 2],
        };
        rests_plot(self.recording, self.segmentation, units)
    }
}

/// Measures every recording under its own biases.
pub fn parts<'a>(
    cut: impl Iterator<Item = (&'a Recording, &'a Segmentation)>,
    calibration: &Calibration,
) -> Result<Vec<Part<'a>>, calib::Error> {
    let mut first = 1;
    cut.map(|(recording, segmentation)| {
        let own = with_own_bias(calibration, &recording.name);
        let measure = |c| misfits(recording, segmentation, c, calibration.gravity);
        let part = Part {
            recording,
            segmentation,
            first,
            left: measure(Some(&own))?,
            raw: in_si(calibration).then(|| measure(None)).transpose()?,
        };
        first += segmentation.statics.len();
        Ok(part)
    })
    .collect()
}

/// The calibration with the biases that hold in one of its recordings.
fn with_own_bias(calibration: &Calibration, recording: &str) -> Calibration {
    let mut own = calibration.clone();
    for triad in [&mut own.accelerometer, &mut own.gyroscope] {
        let Some(triad) = triad else { continue };
        let here = |bias: &&RecordingBias| bias.recording == recording;
        if let Some(bias) = triad.recordings.iter().find(here).map(|own| own.bias) {
            triad.bias = bias;
        }
    }
    own
}

/// Whether readings are in SI units: then scale factors are near one.
fn in_si(calibration: &Calibration) -> bool {
    let near_one = |triad: &Triad| (0..3).all(|k| (0.5..2.0).contains(&triad.t[k][k].abs()));
    [&calibration.accelerometer, &calibration.gyroscope]
        .into_iter()
        .flatten()
        .all(near_one)
}

/// Names of the plots of `recordings` recordings, as files are called.
pub fn plot_names(recordings: usize) -> Vec<String> {
    let cuts = (1..=recordings).map(|k| format!("rests-{k}"));
    ["modulus".to_owned(), "direction".to_owned()]
        .into_iter()
        .chain(cuts)
        .collect()
}

/// The plots, in the order of [`plot_names`].
pub fn plots(parts: &[Part<'_>]) -> Vec<Plot> {
    let modulus = Plot::new(
        "What is left of gravity's modulus in each rest",
        Axis::linear("rest, numbered through all recordings"),
        Axis::linear("modulus less gravity, mm/s²"),
    );
    let direction = Plot::new(
        "Error of gravity's direction, foretold through each turn",
        Axis::linear("turn, by the number of the rest before it"),
        Axis::linear("angle, °"),
    );
    [
        residuals(modulus, parts, |misfits| &misfits.rests, 1e3),
        residuals(direction, parts, |misfits| &misfits.turns, 1.0),
    ]
    .into_iter()
    .chain(parts.iter().map(Part::cut))
    .collect()
}

/// Dots per recording, the raw readings in grey behind them.
fn residuals(
    mut plot: Plot,
    parts: &[Part<'_>],
    of: fn(&Misfits) -> &Vec<Misfit>,
    factor: f64,
) -> Plot {
    let dots = |part: &Part<'_>, misfits: &[Misfit]| -> Vec<(f64, f64)> {
        let dot = |m: &Misfit| ((part.first + m.index) as f64, factor * m.value);
        misfits.iter().map(dot).collect()
    };
    let raw: Vec<_> = parts
        .iter()
        .filter_map(|part| Some(dots(part, of(part.raw.as_ref()?))))
        .flatten()
        .collect();
    if !raw.is_empty() {
        plot = plot.with(Series::dots("raw", GREY, raw));
    }
    for (colour, part) in parts.iter().enumerate() {
        let name = show::name(&part.recording.name);
        // The palette ends in the grey of the raw readings.
        plot = plot.with(Series::dots(
            name,
            colour % GREY,
            dots(part, of(&part.left)),
        ));
    }
    plot
}

/// The page.
pub fn page(
    calibration: &Calibration,
    parts: &[Part<'_>],
    plots: &[Plot],
    units: [&str; 2],
) -> Result<Report, Failure> {
    let failed = limits::reasons(calibration).into_iter();
    let mut notes: Vec<String> = failed.map(|gate| format!("Do not use: {gate}")).collect();
    notes.extend(calibration.warnings.iter().cloned());
    let mut report = Report::new("Calibration")
        .warnings(&notes)
        .section("How it was made")
        .text(format!(
            "Method {}, gravity {} m/s², {} recordings.",
            calibration.method,
            calibration.gravity,
            parts.len()
        ));
    if let Some(triad) = &calibration.accelerometer {
        report = sensor(
            report,
            "Accelerometer, a = T (A − b)",
            triad,
            units[0],
            "accel",
        );
        if let Some(plot) = plots.first().filter(|_| any(parts, |m| &m.rests)) {
            report =
                report
                    .plot(plot)?
                    .text(left(parts, |m| &m.rests, 1e3, ["rests", " mm/s²"], triad));
        }
    }
    if let Some(triad) = &calibration.gyroscope {
        report = sensor(report, "Gyroscope, w = T (W − b)", triad, units[1], "gyro");
        if let Some(plot) = plots.get(1).filter(|_| any(parts, |m| &m.turns)) {
            report = report
                .plot(plot)?
                .text(left(parts, |m| &m.turns, 1.0, ["turns", "°"], triad))
                .text("The rate left in the two rests beside a turn is taken off as bias.");
        }
    }
    report = effects(report, calibration);
    if !parts.is_empty() {
        report = report.section("Rests and turns");
    }
    for (part, plot) in parts.iter().zip(plots.iter().skip(2)) {
        report = report.plot(plot)?.table(intervals(part));
    }
    Ok(report)
}

/// Whether there is anything of the kind.
fn any(parts: &[Part<'_>], of: fn(&Misfits) -> &Vec<Misfit>) -> bool {
    parts.iter().any(|part| !of(&part.left).is_empty())
}

fn sensor(report: Report, heading: &str, triad: &Triad, unit: &str, prefix: &str) -> Report {
    let mut table = ReportTable::new(PARAMETERS);
    for row in tables::parameters(triad, unit, prefix) {
        table.row(row);
    }
    let mut report = report.section(heading).table(table).text(format!(
        "Condition {:.1}, rank {}.",
        triad.condition, triad.rank
    ));
    for what in &triad.unobservable {
        report = report.text(format!("Not observable: {what}"));
    }
    report
}

/// `3.1 mm/s² rms are left in 24 rests (raw 21.1 mm/s²)`, and how much that is.
fn left(
    parts: &[Part<'_>],
    of: fn(&Misfits) -> &Vec<Misfit>,
    factor: f64,
    [places, unit]: [&str; 2],
    triad: &Triad,
) -> String {
    let rms = |misfits: Vec<&Misfits>| {
        let all: Vec<f64> = misfits
            .iter()
            .flat_map(|m| of(m))
            .map(|m| m.value)
            .collect();
        let squares: f64 = all.iter().map(|v| v * v).sum();
        (
            all.len(),
            factor * (squares / all.len().max(1) as f64).sqrt(),
        )
    };
    let (count, after) = rms(parts.iter().map(|p| &p.left).collect());
    let raw: Vec<&Misfits> = parts.iter().filter_map(|p| p.raw.as_ref()).collect();
    let before = if raw.is_empty() {
        String::new()
    } else {
        format!(" (raw {:.2}{unit})", rms(raw).1)
    };
    let noise = tables::over_noise(triad);
    format!("{after:.2}{unit} rms are left in {count} {places}{before}{noise}.")
}

fn effects(mut report: Report, calibration: &Calibration) -> Report {
    for effect in &calibration.effects {
        let mut table = ReportTable::new(PARAMETERS);
        for p in &effect.parameters {
            let digits = |v: f64| format!("{v:.3e}");
            table.row([
                p.name.clone(),
                digits(p.value),
                p.std.map_or("fixed".into(), digits),
                p.unit.clone(),
            ]);
        }
        report = report.section(effect.name.clone()).table(table);
    }
    report
}

fn intervals(part: &Part<'_>) -> ReportTable {
    let mut table = ReportTable::new([
        "rest",
        "from, s",
        "to, s",
        "|f| − g, mm/s²",
        "turn after it",
        "angle, °",
    ]);
    let at = |all: &[Misfit], index: usize| all.iter().find(|m| m.index == index).map(|m| m.value);
    for (index, rest) in part.segmentation.statics.iter().enumerate() {
        let turn = part.segmentation.turns.iter().find(|t| t.from == index);
        let words = match turn {
            Some(turn) => turn
                .fault
                .as_ref()
                .map_or("used".into(), ToString::to_string),
            None => String::new(),
        };
        table.row([
            (part.first + index).to_string(),
            format!("{:.2}", rest.span.from),
            format!("{:.2}", rest.span.to),
            at(&part.left.rests, index).map_or(String::new(), |v| format!("{:+.2}", 1e3 * v)),
            words,
            at(&part.left.turns, index).map_or(String::new(), |v| format!("{v:.3}")),
        ]);
    }
    table
}
