//! Control charts: individuals and moving ranges, means and spreads by lot.

use batch::Record;
use batch::statistics::{Chart, individuals, means_by_lot, seconds, spreads_by_lot};

use crate::exit::Failure;
use crate::report::{Axis, Plot, Report, ReportTable, Series};

/// Dots of a chart, what is beyond its limits not counted.
const CHARTED: usize = 1500;
/// Parameters with charts of their own.
const CHARTS: usize = 2;

/// Control charts of every parameter that leaves its limits, of the first otherwise.
pub(super) fn charts(
    report: Report,
    records: &[Record],
    names: &[String],
) -> Result<Report, Failure> {
    let mut report = report.section("Control charts").text(
        "Individuals and moving ranges in the order of time, else of the manifest; means and standard deviations by lot. Limits are \
         three standard deviations, by moving ranges and within lots.",
    );
    let mut order: Vec<&Record> = records
        .iter()
        .filter(|r| !r.parameters.is_empty())
        .collect();
    let time = |r: &Record| r.time.as_deref().and_then(seconds);
    if order.iter().all(|r| time(r).is_some()) {
        order.sort_by(|a, b| time(a).unwrap_or(0.0).total_cmp(&time(b).unwrap_or(0.0)));
    }
    let mut lots: Vec<&str> = order.iter().filter_map(|r| r.lot.as_deref()).collect();
    lots.sort_unstable();
    lots.dedup();
    let mut table = ReportTable::new([
        "parameter",
        "individuals beyond",
        "moving ranges beyond",
        "lot means beyond",
        "lot spreads beyond",
    ]);
    let (mut drawn, mut rows) = (0, 0);
    for name in names {
        let all: Vec<f64> = order
            .iter()
            .filter_map(|r| Some(r.parameter(name)?.0))
            .collect();
        let by_lot: Vec<Vec<f64>> = lots
            .iter()
            .map(|lot| {
                let own = order.iter().filter(|r| r.lot.as_deref() == Some(*lot));
                own.filter_map(|r| Some(r.parameter(name)?.0)).collect()
            })
            .collect();
        let Some((own, ranges)) = individuals(&all) else {
            continue;
        };
        let (means, spreads) = (means_by_lot(&by_lot), spreads_by_lot(&by_lot));
        let count = |chart: &Option<Chart>| {
            chart
                .as_ref()
                .map_or("-".to_owned(), |c| c.beyond.len().to_string())
        };
        let beyond = [
            own.beyond.len().to_string(),
            ranges.beyond.len().to_string(),
            count(&means),
            count(&spreads),
        ];
        let out = beyond.iter().any(|n| n != "0" && n != "-");
        let [a, b, c, d] = beyond;
        table.row([name.clone(), a, b, c, d]);
        rows += 1;
        if out && drawn < CHARTS || drawn == 0 {
            drawn += 1;
            report = report.plot(&chart(name, "device", &own).into());
            report =
                report.plot(&chart(&format!("{name}: moving range"), "device", &ranges).into());
            for (what, by) in [("mean", &means), ("standard deviation", &spreads)] {
                if let Some(by) = by {
                    let title = format!("{name}: {what} by lot");
                    report = report.plot(&chart(&title, "lot, by name", by).into());
                }
            }
        }
    }
    Ok(if rows == 0 {
        report.text("Too few devices for a chart.")
    } else {
        report.table(table)
    })
}

fn chart(title: &str, what: &str, chart: &Chart) -> Plot {
    let at = |k: usize| (k + 1) as f64;
    let every = chart.points.len().div_ceil(CHARTED).max(1);
    let points = chart.points.iter().enumerate().step_by(every);
    let points = points.map(|(k, v)| (at(k), *v)).collect();
    let beyond = chart
        .beyond
        .iter()
        .map(|k| (at(*k), chart.points[*k]))
        .collect();
    let limit = |side: usize| {
        chart
            .limits
            .iter()
            .enumerate()
            .map(|(k, l)| (at(k), l[side]))
            .collect()
    };
    let centre = vec![
        (1.0, chart.centre),
        (at(chart.points.len() - 1), chart.centre),
    ];
    Plot::new(title, Axis::linear(what), Axis::linear(title))
        .with(Series::dashed("limits", 2, limit(0)))
        .with(Series::dashed("", 2, limit(1)))
        .with(Series::line("centre", 6, centre))
        .with(Series::dots("value", 0, points))
        .with(Series::dots("beyond", 1, beyond))
}
