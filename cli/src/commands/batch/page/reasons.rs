//! Why devices fail, the commonest reason first.

use batch::Record;
use batch::statistics::pareto;

use super::ROWS;
use crate::commands::batch::tables::short;
use crate::exit::Failure;
use crate::report::{Axis, Plot, Report, ReportTable, Series};
use crate::show;

/// Bars of the picture.
const BARS: usize = 24;

/// Reasons, the commonest first, and what is left when each is cured.
pub(super) fn reasons(report: Report, records: &[Record]) -> Result<Report, Failure> {
    let causes = pareto(records);
    if causes.is_empty() {
        return Ok(report.text("No device failed."));
    }
    let failed: usize = causes.iter().map(|c| c.count).sum();
    let mut table = ReportTable::new([
        "number",
        "reason",
        "devices",
        "share of failures",
        "so far",
        "example",
    ]);
    let mut so_far = 0;
    for (k, cause) in causes.iter().take(ROWS).enumerate() {
        so_far += cause.count;
        let share = |n: usize| format!("{:.1} %", 100.0 * n as f64 / failed as f64);
        table.row([
            (k + 1).to_string(),
            short(&cause.words, 80),
            cause.count.to_string(),
            share(cause.count),
            share(so_far),
            show::name(&cause.example),
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
        Axis::linear("reason, numbered as in the table"),
        Axis::linear("devices"),
    )
    .with(Series::line("", 0, corners.collect()));
    let report = report.section("Why devices fail");
    Ok(report.plot(&plot.into()).table(table))
}
