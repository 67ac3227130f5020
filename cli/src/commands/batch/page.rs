//! The report of a batch.

use batch::statistics::{
    by_station, individuals, means_by_lot, median, outliers, over_time, pareto, seconds,
    shared_effects, spread, spreads_by_lot,
};
use batch::{Record, Status};
use calib::limits::Limit;
use nalgebra::DVector;

use super::tables::{short, summary};
use crate::commands::limits::number;
use crate::exit::Failure;
use crate::report::{Axis, Plot, Report, ReportTable, Series};
use crate::show;

/// Chance of calling any device of a sound batch an outlier.
const ALPHA: f64 = 0.01;
/// A change or a difference between stations that chance makes less often than this is said, over all parameters.
const SHOWN: f64 = 0.01;
/// Rows of a table of devices.
const ROWS: usize = 30;
/// Spreads from the median beyond which a device is drawn by itself, and how many of each parameter.
const FAR: f64 = 3.5;
const DOTS: usize = 200;
/// Dots of a chart, what is beyond its limits not counted.
const CHARTED: usize = 1500;
/// Parameters with charts of their own.
const CHARTS: usize = 2;
/// Bars of a histogram.
const BARS: usize = 24;

/// The page.
pub fn page(records: &[Record]) -> Result<Report, Failure> {
    let mut report = Report::new("Batch")
        .section("Yield")
        .text(format!("{}.", summary(records)));
    report = reasons(report, records)?;
    let names = names(records);
    report = distributions(report, records, &names)?;
    report = odd(report, records, &names);
    report = drifts(report, records, &names);
    report = charts(report, records, &names)?;
    Ok(shared(report, records))
}

/// Reasons, the commonest first, and what is left when each is cured.
fn reasons(report: Report, records: &[Record]) -> Result<Report, Failure> {
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

/// Names of the parameters that most calibrated devices have.
fn names(records: &[Record]) -> Vec<String> {
    let calibrated = records.iter().filter(|r| !r.parameters.is_empty()).count();
    let mut names: Vec<(String, usize)> = Vec::new();
    for parameter in records.iter().flat_map(|r| &r.parameters) {
        match names.iter_mut().find(|(name, _)| *name == parameter.name) {
            Some((_, count)) => *count += 1,
            None => names.push((parameter.name.clone(), 1)),
        }
    }
    names.retain(|(_, count)| 2 * count > calibrated);
    names.into_iter().map(|(name, _)| name).collect()
}

fn values(records: &[Record], name: &str) -> Vec<f64> {
    records
        .iter()
        .filter_map(|r| Some(r.parameter(name)?.0))
        .collect()
}

/// Each parameter's median, spread, the sessions' own error, and its limits.
fn distributions(report: Report, records: &[Record], names: &[String]) -> Result<Report, Failure> {
    let mut table = ReportTable::new([
        "number",
        "parameter",
        "median",
        "spread",
        "session's error",
        "least",
        "greatest",
        "limits",
    ]);
    let mut report = report.section("Parameters");
    for (k, name) in names.iter().enumerate() {
        let all = values(records, name);
        let errors: Vec<f64> = records
            .iter()
            .filter_map(|r| r.parameter(name)?.1)
            .collect();
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let limit = limits_of(records, name);
        let limit = limit.map_or(String::new(), |[low, high]| {
            format!("{} to {}", number(low), number(high))
        });
        table.row([
            (k + 1).to_string(),
            name.clone(),
            number(median(&all)),
            number(spread(&all)),
            number(median(&errors)),
            number(least),
            number(greatest),
            limit,
        ]);
    }
    if !names.is_empty() {
        report = report.plot(&spreads(records, names).into());
    }
    report = report.table(table);
    for name in names
        .iter()
        .filter(|name| limits_of(records, name).is_some())
    {
        if let Some(plot) = histogram(records, name) {
            report = report.plot(&plot.into());
        }
    }
    Ok(report)
}

/// All parameters in one picture: the middle 90 % of the devices as a bar, those further out than `FAR` spreads as dots.
fn spreads(records: &[Record], names: &[String]) -> Plot {
    let (mut bars, mut dots) = (Vec::new(), Vec::new());
    for (k, name) in names.iter().enumerate() {
        let mut all = values(records, name);
        let (centre, width) = (median(&all), spread(&all));
        if width.is_nan() || width <= 0.0 {
            continue;
        }
        all.sort_by(f64::total_cmp);
        let at = (k + 1) as f64;
        let quantile =
            |share: f64| (all[((all.len() - 1) as f64 * share).round() as usize] - centre) / width;
        bars.push((at, 0.0, quantile(0.05), quantile(0.95)));
        let far = all
            .iter()
            .map(|v| (v - centre) / width)
            .filter(|z| z.abs() > FAR);
        dots.extend(far.take(DOTS).map(|z| (at, z)));
    }
    Plot::new(
        "Parameters: middle 90 % of the devices, and those far out",
        Axis::linear("parameter, numbered as in the table"),
        Axis::linear("from the median, in spreads"),
    )
    .with(Series::bars("middle 90 %", 0, bars))
    .with(Series::dots("far out", 1, dots))
}

/// The limits of a parameter's value.
fn limits_of(records: &[Record], name: &str) -> Option<[f64; 2]> {
    let key = format!("values.{name}");
    let line = records
        .iter()
        .flat_map(|r| &r.limits)
        .find(|line| line.name == key)?;
    match line.limit {
        Limit::Range(range) => Some(range),
        Limit::One(_) => None,
    }
}

fn histogram(records: &[Record], name: &str) -> Option<Plot> {
    let all = values(records, name);
    let (centre, width) = (median(&all), spread(&all));
    if all.len() < 5 || width.is_nan() || width <= 0.0 {
        return None;
    }
    let near: Vec<f64> = all
        .iter()
        .copied()
        .filter(|v| (v - centre).abs() <= 6.0 * width)
        .collect();
    let least = near.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = near.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let bins = BARS.min(near.len().isqrt() * 2).max(5);
    let step = (greatest - least) / bins as f64;
    let mut counts = vec![0.0; bins];
    for v in &near {
        counts[(((v - least) / step) as usize).min(bins - 1)] += 1.0;
    }
    let edge = |k: usize| least + step * k as f64;
    let top: Vec<(f64, f64)> = (0..bins)
        .flat_map(|k| [(edge(k), counts[k]), (edge(k + 1), counts[k])])
        .collect();
    let mut line = vec![(least, 0.0)];
    line.extend(top);
    line.push((greatest, 0.0));
    let most = counts.iter().copied().fold(0.0, f64::max);
    let beyond = all.len() - near.len();
    let beyond = if beyond > 0 {
        format!(" ({beyond} further out)")
    } else {
        String::new()
    };
    let mut plot = Plot::new(
        format!("{name}{beyond}"),
        Axis::linear(name),
        Axis::linear("devices"),
    )
    .with(Series::line("", 0, line));
    for limit in limits_of(records, name)
        .into_iter()
        .flatten()
        .filter(|l| (l - centre).abs() < 8.0 * width)
    {
        plot = plot.with(Series::dashed("", 1, vec![(limit, 0.0), (limit, most)]));
    }
    Some(plot)
}

/// Devices far from the others, all parameters taken together.
fn odd(report: Report, records: &[Record], names: &[String]) -> Report {
    let whole: Vec<(&Record, DVector<f64>)> = records
        .iter()
        .filter_map(|r| {
            let values: Option<Vec<f64>> = names.iter().map(|n| Some(r.parameter(n)?.0)).collect();
            Some((r, DVector::from_vec(values?)))
        })
        .collect();
    let sample: Vec<DVector<f64>> = whole.iter().map(|(_, v)| v.clone()).collect();
    let report = report.section("Outliers");
    if names.is_empty() || sample.len() < 3 * names.len() {
        return report.text(format!(
            "{} devices with {} parameters: too few to tell an outlier from the others (three devices per parameter).",
            sample.len(),
            names.len()
        ));
    }
    let found = outliers(&sample, ALPHA);
    let mut table = ReportTable::new([
        "device",
        "distance",
        "chance over the batch",
        "furthest in",
        "standard deviations",
    ]);
    for o in found.iter().take(ROWS) {
        table.row([
            show::name(&whole[o.index].0.id),
            format!("{:.1}", o.distance),
            format!("{:.1e}", o.p_value),
            names[o.parameter].clone(),
            format!("{:+.1}", o.deviation),
        ]);
    }
    let said = format!(
        "{} of {} devices are outliers by their robust Mahalanobis distance (orthogonalised Gnanadesikan–Kettenring; chance {ALPHA} \
         of any in a sound batch).",
        found.len(),
        sample.len()
    );
    match found.is_empty() {
        true => report.text(said),
        false => report.text(said).table(table),
    }
}

/// Parameters that change over time or differ by station.
fn drifts(report: Report, records: &[Record], names: &[String]) -> Report {
    let mut report = report.section("Drift");
    let mut table = ReportTable::new(["parameter", "change", "std error", "chance"]);
    let (mut drifting, mut looked) = (0, false);
    for name in names {
        let point = |r: &Record| Some((seconds(r.time.as_ref()?)?, r.parameter(name)?.0));
        let Some(drift) = over_time(&records.iter().filter_map(point).collect::<Vec<_>>()) else {
            continue;
        };
        looked = true;
        if drift.p_value < SHOWN / names.len() as f64 {
            drifting += 1;
            table.row([
                name.clone(),
                number(drift.change),
                number(drift.std),
                format!("{:.1e}", drift.p_value),
            ]);
        }
    }
    report = match (looked, drifting) {
        (false, _) => report.text("Over time: the manifest has no time for five devices or more."),
        (true, 0) => {
            report.text("Over time: no parameter changes from the first to the last device.")
        }
        _ => report
            .text("Over time, from the first to the last device:")
            .table(table),
    };
    let mut table = ReportTable::new(["parameter", "mean by station (devices)", "chance"]);
    let (mut differing, mut looked) = (0, false);
    for name in names {
        let point = |r: &Record| Some((r.station.clone()?, r.parameter(name)?.0));
        let Some(shift) = by_station(&records.iter().filter_map(point).collect::<Vec<_>>()) else {
            continue;
        };
        looked = true;
        if shift.p_value < SHOWN / names.len() as f64 {
            differing += 1;
            let means = shift
                .means
                .iter()
                .map(|(s, n, v)| format!("{} {} ({n})", show::name(s), number(*v)));
            table.row([
                name.clone(),
                means.collect::<Vec<_>>().join(", "),
                format!("{:.1e}", shift.p_value),
            ]);
        }
    }
    match (looked, differing) {
        (false, _) => report.text("By station: the manifest names fewer than two stations."),
        (true, 0) => report.text("By station: no parameter differs."),
        _ => report.text("By station:").table(table),
    }
}

/// Control charts of every parameter that leaves its limits, of the first otherwise.
fn charts(report: Report, records: &[Record], names: &[String]) -> Result<Report, Failure> {
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
    let mut drawn = 0;
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
        let count = |chart: &Option<batch::statistics::Chart>| {
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
    Ok(report.table(table))
}

fn chart(title: &str, what: &str, chart: &batch::statistics::Chart) -> Plot {
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

/// What was found in many devices.
fn shared(report: Report, records: &[Record]) -> Report {
    let found = shared_effects(records);
    let unexplained = records
        .iter()
        .filter(|r| {
            r.verdict
                .as_deref()
                .is_some_and(|v| v.contains("unexplained"))
        })
        .count();
    let report = report.section("Effects shared by the type");
    if records.iter().all(|r| r.verdict.is_none()) {
        let failed = records.iter().filter(|r| r.status != Status::Pass).count();
        return report.text(format!(
            "Nothing was looked for ({} devices, {failed} failed): run the batch with --discover.",
            records.len()
        ));
    }
    if found.is_empty() {
        return report.text(format!(
            "No effect was named; {unexplained} devices are unexplained."
        ));
    }
    let mut table = ReportTable::new(["effect", "devices", "share", "typical parameters"]);
    for effect in found.iter().take(ROWS) {
        let prefix = format!("{}.", effect.name);
        let mut own: Vec<String> = Vec::new();
        for parameter in records
            .iter()
            .flat_map(|r| &r.parameters)
            .filter(|p| p.name.starts_with(&prefix))
        {
            if !own.contains(&parameter.name) {
                own.push(parameter.name.clone());
            }
        }
        let words = own.iter().map(|name| {
            let all = values(records, name);
            format!(
                "{} {} ± {}",
                name.trim_start_matches(&prefix),
                number(median(&all)),
                number(spread(&all))
            )
        });
        table.row([
            effect.name.clone(),
            effect.named.to_string(),
            format!(
                "{:.0} %",
                100.0 * effect.named as f64 / effect.of.max(1) as f64
            ),
            short(&words.collect::<Vec<_>>().join(", "), 160),
        ]);
    }
    report
        .text(format!("{unexplained} devices are unexplained."))
        .table(table)
}
