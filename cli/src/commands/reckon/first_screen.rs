//! The first screen of dead reckoning: the error with each calibration.

use super::show_runs::{heading, narrow};
use super::solve::{Outcome, Run};
use crate::commands::shared::first_screen::Screen;
use crate::commands::shared::names::Names;
use crate::pages::session::short_names;
use crate::show;

/// Recordings that are listed one by one.
const LISTED: usize = 12;

/// Builds the first screen; `written` says which files were.
pub(super) fn screen(runs: &[Run], remarks: Vec<String>, written: String) -> Screen {
    let whole: Vec<&str> = runs.iter().map(|run| run.recording.as_str()).collect();
    let names = Names::of_words(&whole);
    let tables = match runs {
        [one] => format!("{}\n{}", names.short(&heading(one)), narrow(one)),
        _ => of_several(runs, &short_names(&whole)),
    };
    Screen {
        verdict: vec![verdict(runs)],
        tables: vec![tables],
        written,
        remarks: names.all_short(&remarks),
        ..Screen::default()
    }
}

/// Returns the error if the truth is known: the mean over the axes, or that of the horizontal distance, m.
fn error(outcome: &Outcome) -> Option<f64> {
    outcome
        .mean_error()
        .or(outcome.distance_error.map(f64::abs))
}

/// The error of every calibration, in m over all recordings; where no truth was given where the motion ended.
fn verdict(runs: &[Run]) -> String {
    let Some(first) = runs.first() else {
        return "No recording was solved.".into();
    };
    let named = first.results.iter().enumerate().map(|(k, outcome)| {
        let errors: Option<Vec<f64>> = runs.iter().map(|run| error(run.results.get(k)?)).collect();
        let mean = errors.map(|errors| errors.iter().sum::<f64>() / errors.len().max(1) as f64);
        (show::name(&outcome.calibration), mean, outcome)
    });
    let named: Vec<_> = named.collect();
    let with_mean = |(name, mean, _): &(String, Option<f64>, _)| Some((name.clone(), (*mean)?));
    let best = named.iter().skip(1).filter_map(with_mean);
    let best = best.min_by(|a, b| a.1.total_cmp(&b.1));
    let raw = named.first().and_then(with_mean);
    // A distance is one number, a position three.
    let is_distance = first.results.iter().any(|o| o.distance_error.is_some());
    let off = match (is_distance, runs.len()) {
        (true, 1) => "the horizontal distance is off by",
        (true, _) => "on average the horizontal distance is off by",
        (false, _) => "on average over x, y and z the position is off by",
    };
    match (best.or(raw.clone()), raw.map(|(_, mean)| mean)) {
        (Some((name, mean)), Some(raw)) if name != "raw" && mean >= raw => format!(
            "With {name} it is no better than with the raw readings: {off} {mean:.3} m (raw {raw:.3} m)."
        ),
        (Some((name, mean)), Some(raw)) if name != "raw" => {
            format!("With {name} {off} {mean:.3} m (raw {raw:.3} m).")
        }
        (Some((name, mean)), _) => {
            format!("With {name} {off} {mean:.3} m.")
        }
        (None, _) => {
            let ended = named
                .last()
                .map_or([0.0; 3], |(.., outcome)| outcome.displacement);
            let name = named.last().map_or("raw", |(name, ..)| name.as_str());
            let [x, y, z] = ended.map(|v| format!("{v:.3}"));
            format!(
                "With {name} the motion ends at {x}, {y}, {z} m. How far that is off is not known: --displacement or --distance \
                 says where it ended."
            )
        }
    }
}

/// The mean error of each recording with each calibration.
fn of_several(runs: &[Run], names: &[String]) -> String {
    let calibrations = runs.first().map_or(&[][..], |run| run.results.as_slice());
    let mut header = vec!["mean |error|, m".to_owned()];
    header.extend(calibrations.iter().map(|o| show::name(&o.calibration)));
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = show::table(&header);
    for (run, name) in runs.iter().zip(names).take(LISTED) {
        let mut row = vec![name.clone()];
        let cell = |outcome: &Outcome| error(outcome).map_or("?".into(), |v| format!("{v:.3}"));
        row.extend(run.results.iter().map(cell));
        table.add_row(row);
    }
    match runs.len().saturating_sub(LISTED) {
        0 => table.to_string(),
        more => format!("{table}\n  … and {more} more with -v"),
    }
}
