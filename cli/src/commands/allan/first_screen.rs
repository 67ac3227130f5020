//! The first screen of an Allan deviation: the terms without their intervals.

use ::findings::Front;
use calib::noise::{NoiseSummary, NoiseTerm, TermValue};

use super::args::Args;
use super::words::{advice, extent, is_in_counts, largest_white, sensors, shown_unit, significant};
use crate::commands::shared::first_screen::{Screen, Step, wrote};
use crate::show;
use crate::show::command_line;

/// Builds the first screen.
pub fn screen(args: &Args, summary: &NoiseSummary) -> Screen {
    let mut recording = command_line(&args.recording) + &args.read.command_line();
    if let Some([from, to]) = args.rest {
        recording += &format!(" --rest {from},{to}");
    }
    let mut next = Vec::new();
    if args.output.is_none() {
        next.push(Step::new(
            "keep the noise",
            format!("stillpoint allan {recording} -o noise.json"),
        ));
    }
    let noise = args
        .output
        .as_deref()
        .map_or("noise.json".into(), command_line);
    // A search takes no walk that nothing bounds.
    let mut walks = [&summary.accelerometer, &summary.gyroscope].into_iter();
    if walks.all(|noise| noise.as_ref().is_some_and(|n| n.random_walk().is_some())) {
        next.push(Step::new(
            "use it in a search",
            format!("stillpoint discover SESSION --noise {noise}"),
        ));
    }
    Screen {
        verdict: vec![verdict(summary)],
        tables: vec![table(summary)],
        next,
        written: wrote(args.output.as_deref(), ""),
        remarks: summary.warnings.texts(Front::CommandLine),
        ..Screen::default()
    }
}

/// The white noise, which every recording at rest shows, and how long to rest before a calibration.
fn verdict(summary: &NoiseSummary) -> String {
    let parts = sensors(summary).map(|(name, sensor, noise)| {
        let unit = match is_in_counts(noise) {
            true => Some(("counts/√Hz", 1.0)),
            false => NoiseTerm::WhiteNoise
                .density_unit(sensor)
                .map(|unit| (unit, 1.0)),
        };
        let (unit, factor) =
            unit.unwrap_or_else(|| shown_unit(NoiseTerm::WhiteNoise, sensor, noise));
        let largest = largest_white(noise, (unit, factor));
        format!("{} {largest}", name.to_lowercase())
    });
    let parts: Vec<String> = parts.collect();
    let advice = show::capital(&advice(summary));
    format!(
        "White noise, largest of the axes: {}. {advice}.",
        parts.join(", ")
    )
}

/// A row for each term that was bounded on some axis.
fn table(summary: &NoiseSummary) -> String {
    let mut lines = Vec::new();
    for (name, sensor, noise) in sensors(summary) {
        let heading = format!("{name}, {}", extent(noise));
        lines.push(format!("  {heading}"));
        for term in NoiseTerm::ALL {
            let (unit, factor) = shown_unit(term, sensor, noise);
            let axis = |k: usize| {
                let value = noise.axes[k].terms.iter().find(|t| t.term == term);
                value.map_or("?".into(), |value| brief(value, factor))
            };
            let [x, y, z] = [axis(0), axis(1), axis(2)];
            if [&x, &y, &z].iter().all(|cell| cell.as_str() == OPEN) {
                continue;
            }
            let name = term.name(sensor);
            lines.push(format!("    {name:<26} {x:>12} {y:>12} {z:>12}  {unit}"));
        }
    }
    lines.push(
        "  < bounds a term that is not needed here; nothing bounds – and terms left out".into(),
    );
    lines.join("\n")
}

/// In place of a term that nothing bounds.
const OPEN: &str = "–";

/// The value, or what bounds it.
fn brief(term: &TermValue, factor: f64) -> String {
    match (term.lower > 0.0, term.upper) {
        (true, Some(_)) => significant(term.value * factor),
        (true, None) => format!("> {}", significant(term.lower * factor)),
        (false, Some(upper)) => format!("< {}", significant(upper * factor)),
        (false, None) => OPEN.into(),
    }
}
