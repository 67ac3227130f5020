//! Why devices fail or are to be used with care, the commonest reason first.

use batch::Record;
use batch::statistics::{cared, pareto};

use super::values::ROWS;
use crate::commands::batch::tables::short;
use crate::exit::Failure;
use crate::report::{Axis, Plot, Report, ReportTable, Series};
use crate::show;

/// Bars of the picture.
const BARS: usize = 24;
/// Smallest upper end of the device axis. A smaller one would have ticks between whole numbers.
const FEWEST: f64 = 5.0;

/// Reasons of failure, what is left when each is cured, and reasons for care.
pub(super) fn reasons(report: Report, records: &[Record]) -> Result<Report, Failure> {
    let report = failures(report, records)?;
    let causes = cared(records);
    if causes.is_empty() {
        return Ok(report);
    }
    let rows = causes.iter().take(ROWS).map(|cause| {
        [
            cause.count.to_string(),
            show::name(&cause.example),
            short(&cause.words, 160),
        ]
    });
    let table = ReportTable::of(["devices", "example", "reason"], rows);
    let report = report.section("Devices that pass and are to be used with care");
    Ok(report.table(table))
}

fn failures(report: Report, records: &[Record]) -> Result<Report, Failure> {
    let causes = pareto(records);
    if causes.is_empty() {
        return Ok(report);
    }
    let failed: usize = causes.iter().map(|c| c.count).sum();
    let mut table = ReportTable::new([
        "number",
        "devices",
        "share of failures",
        "so far",
        "example",
        "reason",
    ]);
    let mut so_far = 0;
    for (k, cause) in causes.iter().take(ROWS).enumerate() {
        so_far += cause.count;
        let share = |n: usize| format!("{:.1} %", 100.0 * n as f64 / failed as f64);
        table.row([
            (k + 1).to_string(),
            cause.count.to_string(),
            share(cause.count),
            share(so_far),
            show::name(&cause.example),
            short(&cause.words, 160),
        ]);
    }
    let corners = causes.iter().take(BARS).enumerate();
    let corners = corners.flat_map(|(k, c)| {
        let (at, n) = ((k + 1) as f64, c.count as f64);
        [
            (at - 0.4, 0.0),
            (at - 0.4, n),
            (at + 0.4, n),
            (at + 0.4, 0.0),
        ]
    });
    let plot = Plot::new(
        "Failed devices by reason",
        Axis::categories(
            "reason, numbered as in the table",
            (1..=causes.len().min(BARS))
                .map(|k| k.to_string())
                .collect(),
        ),
        Axis::linear("devices").between(0.0, FEWEST),
    )
    .with(Series::line("", 0, corners.collect()));
    let report = report.section("Why devices fail");
    Ok(report.plot(&plot.into()).table(table))
}
