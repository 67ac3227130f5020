//! `segment`: the static and dynamic intervals of a recording.

mod args;
mod first_screen;

use ::findings::{Finding, Front};
use std::fmt::Write as _;
use std::path::Path;

pub use args::Args;
use calib::Recording;
use calib::intervals::{Moments, Segmentation, Span};
use calib::methods::{Choice, cut};
use calib::readings::symptoms;
use serde_json::json;

use crate::commands::shared::inputs::{read, spinner};
use crate::commands::shared::pictures::named;
use crate::exit::Failure;
use crate::output::Output;
use crate::pages::coverage::{self, Coverage};
use crate::pages::session::Session;
use crate::pages::{intervals_plot, provenance};
use crate::report::{Figure, Picture, Report, ReportTable};
use crate::show;

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let gravity = args.place.gravity()?.value;
    let (detector, choose) = args.detector.detector()?;
    let inputs: [&Path; 1] = [&args.recording];
    let output = Output::claim_given(args.output.as_deref(), args.replace, &inputs)?;
    let pictures = args.pictures.claim(&["rests"], args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let recording = read(&args.recording, &args.read)?.decimated();
    if recording.is_magnetometer_only() {
        let words = "a magnetometer alone shows no rest; record the accelerometer beside it";
        let words = format!("{}: {words}", show::name(&recording.name));
        return Err(Failure::from(calib::Error::not_enough(words)));
    }
    let progress = spinner("finding static intervals");
    let choice = cut(&recording, &detector, choose, gravity)?;
    progress.finish_and_clear();
    let mut warnings = recording.warnings.texts(Front::CommandLine);
    warnings.extend(remarks(&recording, &choice));
    let document = document(&recording, &choice);
    let json = show::json(&document)?;
    Output::write_given(output, &json)?;
    if pictures.wanted() {
        let segmentation = &choice.segmentation;
        let keys = (1..=segmentation.statics.len()).map(|k| k.to_string());
        let plot = intervals_plot(&recording, segmentation, ["m/s²", "rad/s"], keys.collect());
        let plots = named(["rests"], [plot]);
        let page = report(&recording, &choice, &plots[0].1, gravity)?;
        pictures.write(&plots, &page)?;
    }
    if args.json {
        show::warn_all(&warnings);
        return show::print(&json);
    }
    let screen = first_screen::screen(args, &recording, &choice, gravity, &warnings)?;
    screen.show(|| text(&recording, &choice))
}

/// Returns remarks on the segmentation and on symptoms in the readings.
fn remarks(recording: &Recording, choice: &Choice) -> Vec<String> {
    let found = symptoms(recording, &choice.segmentation);
    let found = found
        .iter()
        .map(|symptom| Finding::from(symptom).text(Front::CommandLine));
    let cut = choice.remarks();
    let cut = cut.iter().map(|remark| remark.text(Front::CommandLine));
    cut.chain(found).collect()
}

fn document(recording: &Recording, choice: &Choice) -> serde_json::Value {
    let moments = |m: &Option<Moments>| {
        m.as_ref().map(|m| {
            json!({
                "samples": m.count,
                "mean": m.mean.as_slice(),
                "std": m.std().as_slice(),
            })
        })
    };
    let segmentation = &choice.segmentation;
    let statics: Vec<_> = segmentation
        .statics
        .iter()
        .map(|rest| {
            json!({
                "t0": rest.span.from,
                "t1": rest.span.to,
                "accelerometer": moments(&rest.accelerometer),
                "gyroscope": moments(&rest.gyroscope),
                "temperature": rest.temperature,
            })
        })
        .collect();
    let turns: Vec<_> = segmentation
        .turns
        .iter()
        .map(|turn| {
            json!({
                "t0": turn.span.from,
                "t1": turn.span.to,
                "from": turn.from + 1,
                "to": turn.from + 2,
                "samples": turn.samples.len(),
                "fault": turn.fault.as_ref().map(ToString::to_string),
            })
        })
        .collect();
    let remarks = remarks(recording, choice);
    let mut warnings = recording.warnings.texts(Front::CommandLine);
    warnings.extend(remarks);
    json!({
        "schema": "stillpoint.segments/1",
        "recording": recording.name,
        "multiplier": segmentation.multiplier,
        "level_at_rest": {
            "accelerometer": segmentation.level_at_rest[0],
            "gyroscope": segmentation.level_at_rest[1],
        },
        "static": statics,
        "dynamic": turns,
        "multipliers_tried": choice.trials,
        "warnings": warnings,
    })
}

/// The page: the picture, the intervals, and how the multiplier was chosen.
fn report(
    recording: &Recording,
    choice: &Choice,
    plot: &Picture,
    gravity: f64,
) -> Result<Report, Failure> {
    let segmentation = &choice.segmentation;
    let mut intervals = ReportTable::new(["interval", "from, s", "to, s", "length, s", "note"]);
    let row = |name: String, span: &Span, note: String| {
        let [from, to, length] = [span.from, span.to, span.length()].map(|v| format!("{v:.2}"));
        [name, from, to, length, note]
    };
    for (k, rest) in segmentation.statics.iter().enumerate() {
        let name = format!("static {}", k + 1);
        intervals.keyed(&(k + 1).to_string(), row(name, &rest.span, String::new()));
        if let Some(turn) = segmentation.turns.get(k) {
            let note = turn
                .fault
                .as_ref()
                .map(|fault| format!("not used: {fault}"));
            let name = format!("turn {}", k + 1);
            intervals.row(row(name, &turn.span, note.unwrap_or_default()));
        }
    }
    let mut trials = ReportTable::new([
        "multiplier",
        "static intervals",
        "residual per degree of freedom, mm/s²",
    ]);
    for trial in &choice.trials {
        let residual = trial
            .residual
            .map_or("-".into(), |r| format!("{:.3}", 1e3 * r));
        trials.row([
            trial.multiplier.to_string(),
            trial.static_intervals.to_string(),
            residual,
        ]);
    }
    let session = Session::of(std::iter::once((recording, segmentation)), None, gravity)?;
    let coverage = Coverage::of(&session.directions());
    let mut warnings = recording.warnings.clone();
    warnings.extend(remarks(recording, choice));
    let next: Vec<String> = coverage.advice().into_iter().collect();
    let turns = segmentation
        .turns
        .iter()
        .filter(|t| t.fault.is_none())
        .count();
    let count = format!("{} static intervals", segmentation.statics.len());
    let mut report = Report::new(format!(
        "Static intervals and turns of {}",
        show::name(&recording.name)
    ))
    .figures([
        Figure::new("Found", count, format!("and {turns} turns between them")),
        coverage.figure(),
    ])
    .next(&next)
    .warnings(&show::folded(&warnings.texts(Front::CommandLine)))
    .provenance(provenance::of_recordings(std::slice::from_ref(recording)))
    .section("Static intervals")
    .plot(plot)
    .plot(&coverage::picture(&session, &coverage))
    .table(intervals);
    if let Some(advice) = turns_left_out(segmentation) {
        report = report.text(advice);
    }
    Ok(report
        .section("Threshold")
        .text(format!(
            "{} times the level at rest.",
            segmentation.multiplier
        ))
        .table(trials))
}

fn text(recording: &Recording, choice: &Choice) -> String {
    let segmentation = &choice.segmentation;
    let mut table = show::table(&[
        "interval",
        "from, s",
        "to, s",
        "mean a, m/s²",
        "std",
        "mean w, rad/s",
        "std",
    ]);
    let triple = |v: &[f64], digits: usize| {
        v.iter()
            .map(|x| format!("{x:>w$.digits$}", w = digits + 3))
            .collect::<Vec<_>>()
            .join(" ")
    };
    let cells = |m: &Option<Moments>, digits: usize| match m {
        Some(m) => [
            triple(m.mean.as_slice(), digits),
            format!("{:.4}", m.std().norm()),
        ],
        None => ["no samples".into(), String::new()],
    };
    for (k, rest) in segmentation.statics.iter().enumerate() {
        let mut row = vec![
            format!("static {}", k + 1),
            format!("{:.2}", rest.span.from),
            format!("{:.2}", rest.span.to),
        ];
        row.extend(cells(&rest.accelerometer, 2));
        row.extend(cells(&rest.gyroscope, 3));
        table.add_row(row);
        if let Some(turn) = segmentation.turns.get(k) {
            table.add_row(vec![
                format!("turn {}", k + 1),
                format!("{:.2}", turn.span.from),
                format!("{:.2}", turn.span.to),
                turn.fault
                    .as_ref()
                    .map_or(String::new(), |fault| format!("not used: {fault}")),
            ]);
        }
    }
    let mut text = format!("{table}\n");
    if let Some(advice) = turns_left_out(segmentation) {
        let _ = writeln!(text, "{advice}");
    }
    let _ = writeln!(
        text,
        "{}: {} static intervals, {} turns; motion where Σ var² of a window reaches {} times its level \
         at rest",
        show::name(&recording.name),
        segmentation.statics.len(),
        segmentation.turns.len(),
        segmentation.multiplier
    );
    for (sensor, level) in ["accelerometer", "gyroscope"]
        .iter()
        .zip(segmentation.level_at_rest)
    {
        if let Some(level) = level {
            let _ = writeln!(
                text,
                "{sensor}: level at rest {level:.3e}, threshold {:.3e}",
                level * segmentation.multiplier
            );
        }
    }
    if !choice.trials.is_empty() {
        let mut trials = show::table(&["multiplier", "static intervals", "residual mm/s² per dof"]);
        for trial in &choice.trials {
            trials.add_row([
                format!("{}", trial.multiplier),
                trial.static_intervals.to_string(),
                trial
                    .residual
                    .map_or("-".into(), |r| format!("{:.3}", 1e3 * r)),
            ]);
        }
        let _ = writeln!(text, "{trials}");
    }
    text
}

/// Advice about turns that are not used; `None` where all are.
fn turns_left_out(segmentation: &Segmentation) -> Option<String> {
    let fault = segmentation.turns.iter().find_map(|t| t.fault.as_ref())?;
    let advice = fault.finding().advice(Front::CommandLine)?;
    Some(format!("Of turns that are not used: {advice}."))
}
