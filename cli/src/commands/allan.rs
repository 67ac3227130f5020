//! `allan`: Allan deviation, noise terms, and how long to rest before a calibration.

mod args;
mod first_screen;
mod source;
mod words;

use ::findings::Front;
use std::fmt::Write as _;
use std::path::Path;

pub use args::Args;

use calib::intervals::Span;
use calib::noise::{AtRest, CurvePoint, NoiseSummary, NoiseTerm, SensorNoise, TermValue};
use sensor::Sensor;
use source::{Source, listed, moved};
use words::{advice, extent, is_in_counts, largest_white, sensors, shown_unit, significant};

use crate::commands::shared::pictures::named;
use crate::exit::Failure;
use crate::output::Output;
use crate::report::{Axis, Figure, Level, Picture, Plot, Report, ReportTable, Series};
use crate::show;

/// Names of the plots.
const PLOTS: [&str; 2] = ["allan-gyroscope", "allan-accelerometer"];

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let inputs: [&Path; 1] = [&args.recording];
    let output = Output::claim_given(args.output.as_deref(), args.replace, &inputs)?;
    let pictures = args.pictures.claim(&PLOTS, args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let summary = summary(args)?;
    let json = show::json(&summary)?;
    Output::write_given(output, &json)?;
    if pictures.wanted() {
        let plots = sensors(&summary).map(|(_, s, noise)| plot(s, noise));
        let names = sensors(&summary).map(|(_, s, _)| match s {
            Sensor::Gyroscope => PLOTS[0],
            Sensor::Accelerometer | Sensor::Magnetometer => PLOTS[1],
        });
        let plots = named(names, plots);
        pictures.write(&plots, &report(&summary, &args.recording, &plots))?;
    }
    if args.json {
        show::warn_all(&summary.warnings.texts(Front::CommandLine));
        return show::print(&json);
    }
    first_screen::screen(args, &summary).show(|| text(&summary))
}

/// The noise of the recording, or of the rest in it that is asked for or the longest.
fn summary(args: &Args) -> Result<NoiseSummary, Failure> {
    let mut source = Source::new(args);
    let mut summary = of_source(&mut source, args)?;
    summary.warnings.extend(source.assumed);
    Ok(summary)
}

fn of_source(source: &mut Source<'_>, args: &Args) -> Result<NoiseSummary, Failure> {
    if let Some([from, to]) = args.rest {
        if from >= to {
            return Err(Failure::usage("--rest T0,T1: T0 must be before T1"));
        }
        let curves = source.curves(Some(Span { from, to }))?;
        return Ok(NoiseSummary::of(&curves)?);
    }
    let curves = source.curves(None)?;
    let rest = match curves.stillness.at_rest() {
        AtRest::Throughout => return Ok(NoiseSummary::of(&curves)?),
        AtRest::For(rest) => rest,
        AtRest::TooShort(longest) => return Err(moved(&curves.stillness, longest)),
    };
    let mut summary = NoiseSummary::of(&source.curves(Some(rest))?)?;
    let warning = format!(
        "the device moved ({}): only the longest rest, t = {:.2} to {:.2} s, is analysed; --rest {:.2},{:.2} \
         says so without this warning",
        listed(&curves.stillness.motions),
        rest.from,
        rest.to,
        rest.from,
        rest.to
    );
    summary.warnings.push_first(warning);
    Ok(summary)
}

/// `value [lower, upper]`, or what bounds it.
fn cell(term: &TermValue, factor: f64) -> String {
    let number = |v: f64| significant(v * factor);
    match (term.lower > 0.0, term.upper) {
        (true, Some(upper)) => {
            format!(
                "{} [{}, {}]",
                number(term.value),
                number(term.lower),
                number(upper)
            )
        }
        (true, None) => format!("> {}", number(term.lower)),
        (false, Some(upper)) => format!("< {}", number(upper)),
        (false, None) => "not bounded".into(),
    }
}

/// Rows of the table of one sensor: the terms in the units of data sheets, and the two that filters take as densities.
fn rows(sensor: Sensor, noise: &SensorNoise) -> Vec<[String; 5]> {
    let row = |name: &str, term: NoiseTerm, unit: &str, factor: f64| {
        let axis = |k: usize| {
            let value = noise.axes[k].terms.iter().find(|t| t.term == term);
            value.map_or("?".into(), |value| cell(value, factor))
        };
        [name.into(), unit.into(), axis(0), axis(1), axis(2)]
    };
    let mut rows: Vec<_> = NoiseTerm::ALL
        .into_iter()
        .map(|term| {
            let (unit, factor) = shown_unit(term, sensor, noise);
            row(term.name(sensor), term, unit, factor)
        })
        .collect();
    // Counts are in these units already.
    if !is_in_counts(noise) {
        let densities = DENSITIES.into_iter();
        rows.extend(densities.filter_map(|(term, name)| {
            let unit = term.density_unit(sensor)?;
            Some(row(name, term, unit, 1.0))
        }));
    }
    rows
}

/// Names of the noise terms in the configuration of filters.
const DENSITIES: [(NoiseTerm, &str); 2] = [
    (NoiseTerm::WhiteNoise, "noise density"),
    (NoiseTerm::RandomWalk, "bias random walk"),
];

const HEADER: [&str; 5] = ["term", "unit", "x", "y", "z"];

const INTERVALS: &str = "value [interval]; the five intervals of an axis hold together with 95 % \
                         confidence; < bounds a term that this recording does not need";

fn text(summary: &NoiseSummary) -> String {
    let mut text = String::new();
    for (name, sensor, noise) in sensors(summary) {
        let table = show::table_of(&HEADER, rows(sensor, noise));
        let _ = writeln!(text, "{name}: {}\n{table}\n", extent(noise));
    }
    let _ = writeln!(text, "{INTERVALS}");
    let _ = writeln!(text, "{}", advice(summary));
    text
}

fn plot(sensor: Sensor, noise: &SensorNoise) -> Plot {
    let (name, unit) = match sensor {
        Sensor::Gyroscope => ("gyroscope", "rad/s"),
        Sensor::Accelerometer => ("accelerometer", "m/s²"),
        Sensor::Magnetometer => ("magnetometer", "µT"),
    };
    let unit = if is_in_counts(noise) { "counts" } else { unit };
    let mut plot = Plot::new(
        format!("Allan deviation of the {name} (bars 95 %, fit dashed)"),
        Axis::log("averaging time τ, s"),
        Axis::log(format!("Allan deviation σ(τ), {unit}")),
    );
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let curve = &noise.axes[k].curve;
        let bar = |p: &CurvePoint| {
            let (low, high) = (
                p.lower.unwrap_or(p.deviation),
                p.upper.unwrap_or(p.deviation),
            );
            (p.tau, p.deviation, low, high)
        };
        plot = plot.with(Series::bars(axis, k, curve.iter().map(bar).collect()));
        let fitted: Vec<_> = curve
            .iter()
            .filter_map(|p| Some((p.tau, p.fitted?)))
            .collect();
        if !fitted.is_empty() {
            plot = plot.with(Series::dashed("", k, fitted));
        }
    }
    plot
}

fn report(summary: &NoiseSummary, recording: &Path, plots: &[(String, Picture)]) -> Report {
    let title = format!("Noise of {}", show::path(recording));
    let mut figures: Vec<Figure> = sensors(summary)
        .map(|(n, s, noise)| figure(n, s, noise))
        .collect();
    let time = summary.initial_static_time;
    let time = time.map_or("unknown".into(), |t| format!("{} s", t.ceil()));
    figures.push(Figure::new(
        "Initial static time",
        time,
        "to rest before a calibration",
    ));
    let level = if summary.warnings.is_empty() {
        Level::Good
    } else {
        Level::Care
    };
    let next = [
        "Write the terms for `discover`, which then tells drift from noise sooner: stillpoint allan RECORDING -o noise.json"
            .to_owned(),
        format!("Record a calibration: {}.", advice(summary)),
    ];
    let mut report = Report::new(title)
        .verdict(level, sentence(summary))
        .figures(figures)
        .next(&next)
        .warnings(&show::folded(&summary.warnings.texts(Front::CommandLine)))
        .provenance(provenance(summary, recording));
    for ((name, sensor, noise), (_, plot)) in sensors(summary).zip(plots) {
        let table = ReportTable::of(HEADER, rows(sensor, noise));
        report = report
            .section(name)
            .text(extent(noise))
            .plot(plot)
            .text("Points: overlapping Allan deviation with 95 % intervals. Broken lines: the sum of the \
                   five noise terms.")
            .table(table)
            .text(INTERVALS);
    }
    report
}

/// Returns a sentence with the number of noise terms that the recording bounds, or with the first warning.
fn sentence(summary: &NoiseSummary) -> String {
    if let Some(warning) = summary.warnings.first() {
        return format!(
            "The noise was measured, with care: {}.",
            warning.text(Front::CommandLine)
        );
    }
    let told = |noise: &SensorNoise| {
        let all = noise.axes.iter().flat_map(|axis| &axis.terms);
        all.filter(|t| t.lower > 0.0 && t.upper.is_some()).count()
    };
    let parts = sensors(summary).map(|(name, _, noise)| {
        format!("{} of 15 terms of the {}", told(noise), name.to_lowercase())
    });
    let parts: Vec<String> = parts.collect();
    format!(
        "The recording bounds {} on both sides.",
        parts.join(" and ")
    )
}

/// The white noise of a sensor, largest of its axes.
fn figure(name: &str, sensor: Sensor, noise: &SensorNoise) -> Figure {
    let largest = largest_white(noise, shown_unit(NoiseTerm::WhiteNoise, sensor, noise));
    let label = format!("{name}, white noise");
    Figure::new(&label, largest, extent(noise))
}

fn provenance(summary: &NoiseSummary, recording: &Path) -> Vec<[String; 2]> {
    let mut rows = vec![["recording".to_owned(), show::path(recording)]];
    rows.extend(sensors(summary).map(|(name, _, noise)| [name.to_lowercase(), extent(noise)]));
    rows.push([
        "program".into(),
        concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
    ]);
    rows
}
