//! Tables, plots and the report of `reckon`.

use std::fmt::Write as _;
use std::path::PathBuf;

use super::solve::{Outcome, Run};
use crate::report::{Axis, Picture, Plot, Report, ReportTable, Series};
use crate::show;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Names of the plots: three for each recording.
pub(super) fn plot_names(recordings: &[PathBuf]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for path in recordings {
        let stem = path
            .file_stem()
            .map_or_else(|| "recording".into(), |s| s.to_string_lossy());
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() || c == '-' {
                c
            } else {
                '_'
            }
        };
        let stem: String = stem.chars().map(plain).collect();
        let taken = |name: &String| names.iter().any(|n| n.starts_with(&format!("{name}-")));
        let numbered = (2..).map(|k| format!("{stem}-{k}"));
        let name = std::iter::once(stem.clone())
            .chain(numbered)
            .find(|name| !taken(name));
        let name = name.unwrap_or(stem);
        names.extend(AXES.map(|axis| format!("{name}-{axis}")));
    }
    names
}

/// Position along each axis against time, all calibrations in one plot.
pub(super) fn plots(runs: &[Run]) -> Vec<Plot> {
    let plot = |run: &Run, axis: usize| {
        let mut plot = Plot::new(
            format!(
                "{}: position along {}",
                show::name(&run.recording),
                AXES[axis]
            ),
            Axis::linear("time since the start of the motion, s"),
            Axis::linear(format!("position along {}, m", AXES[axis])),
        );
        for (k, outcome) in run.results.iter().enumerate() {
            let line = outcome.path.iter().map(|(t, p)| (*t, p[axis])).collect();
            plot = plot.with(Series::line(show::name(&outcome.calibration), k, line));
        }
        let first = run.results.first();
        if let Some((outcome, error)) = first.and_then(|o| Some((o, o.error?))) {
            let truth = outcome.displacement[axis] - error[axis];
            let last = outcome.path.last().map_or(0.0, |(t, _)| *t);
            plot = plot.with(Series::dashed(
                "true end",
                6,
                vec![(0.0, truth), (last, truth)],
            ));
        }
        plot
    };
    runs.iter()
        .flat_map(|run| (0..3).map(move |axis| plot(run, axis)))
        .collect()
}

/// The columns of a table: the name of one and what it shows of an outcome.
type Column = (&'static str, fn(&Outcome) -> Option<String>);

const COLUMNS: [Column; 12] = [
    ("x, m", |o| metres(o.displacement[0])),
    ("y, m", |o| metres(o.displacement[1])),
    ("z, m", |o| metres(o.displacement[2])),
    ("error x, m", |o| metres(o.error?[0])),
    ("error y, m", |o| metres(o.error?[1])),
    ("error z, m", |o| metres(o.error?[2])),
    ("mean |error|, m", |o| metres(o.mean_error()?)),
    ("horizontal, m", |o| metres(o.horizontal?)),
    ("error, m", |o| metres(o.distance_error?)),
    ("vertical, m", |o| metres(o.vertical?)),
    ("tilt taken off, °", |o| metres(o.end_tilt?)),
    ("samples", |o| Some(o.samples?.to_string())),
];

fn metres(value: f64) -> Option<String> {
    Some(format!("{value:.3}"))
}

/// Header and rows of one run, without the columns that nothing is known of.
pub(super) fn table(run: &Run) -> (Vec<&'static str>, Vec<Vec<String>>) {
    let used: Vec<&Column> = COLUMNS
        .iter()
        .filter(|(_, cell)| run.results.iter().any(|outcome| cell(outcome).is_some()))
        .collect();
    let mut header = vec!["calibration"];
    header.extend(used.iter().map(|(name, _)| *name));
    let rows = run.results.iter().map(|outcome| {
        let mut row = vec![show::name(&outcome.calibration)];
        row.extend(
            used.iter()
                .map(|(_, cell)| cell(outcome).unwrap_or_default()),
        );
        row
    });
    (header, rows.collect())
}

/// Columns of numbers beside each other on a terminal.
const BESIDE: usize = 6;

/// The table of one run, in parts that a terminal has room for.
pub(super) fn narrow(run: &Run) -> String {
    let (header, rows) = table(run);
    let places: Vec<usize> = (1..header.len()).collect();
    let parts = places.chunks(BESIDE).map(|part| {
        let wanted = || std::iter::once(0).chain(part.iter().copied());
        let names: Vec<&str> = wanted().map(|k| header[k]).collect();
        let cells = |row: &Vec<String>| wanted().map(|k| row[k].clone()).collect::<Vec<_>>();
        show::table_of(&names, rows.iter().map(cells)).to_string()
    });
    parts.collect::<Vec<_>>().join("\n\n")
}

/// Header of [`means`].
const MEANS: [&str; 2] = ["all recordings", "mean |error|, m"];

/// Mean absolute error over all recordings and axes by calibration; empty without truth or with one
/// recording.
fn means(runs: &[Run]) -> Vec<[String; 2]> {
    let Some(first) = runs.first().filter(|_| runs.len() > 1) else {
        return Vec::new();
    };
    let row = |(k, outcome): (usize, &Outcome)| {
        let errors = runs.iter().map(|run| run.results.get(k)?.mean_error());
        let errors: Vec<f64> = errors.collect::<Option<_>>()?;
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        Some([show::name(&outcome.calibration), format!("{mean:.3}")])
    };
    first.results.iter().enumerate().filter_map(row).collect()
}

pub(super) fn heading(run: &Run) -> String {
    let motion = run
        .motion
        .map(|m| format!(", motion from {:.2} to {:.2} s", m.from, m.to));
    format!(
        "{}{}",
        show::name(&run.recording),
        motion.unwrap_or_default()
    )
}

pub(super) fn text(runs: &[Run]) -> String {
    let mut text = String::new();
    for run in runs {
        let _ = writeln!(text, "{}\n{}\n", heading(run), narrow(run));
    }
    let means = means(runs);
    if !means.is_empty() {
        let _ = writeln!(text, "{}", show::table_of(&MEANS, means));
    }
    text
}

pub(super) fn report(runs: &[Run], plots: &[(String, Picture)]) -> Report {
    let warnings: Vec<String> = runs.iter().flat_map(|run| run.warnings.clone()).collect();
    let mut report = Report::new("Dead reckoning").warnings(&show::folded(&warnings));
    let means = means(runs);
    if !means.is_empty() {
        let table = ReportTable::of(MEANS, means);
        report = report.section("All recordings").table(table);
    }
    for (run, plots) in runs.iter().zip(plots.chunks(3)) {
        let (header, rows) = table(run);
        let table = ReportTable::of(header, rows);
        report = report.section(heading(run)).table(table);
        for (_, plot) in plots {
            report = report.plot(plot);
        }
    }
    report
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plots_of_recordings_with_one_name_get_names_of_their_own() {
        let names = plot_names(&["a/run 1".into(), "b/run 1".into()]);
        assert_eq!(names[0], "run_1-x");
        assert_eq!(names[3], "run_1-2-x");
    }
}
