//! Distribution of each parameter over the devices.

use batch::Record;
use batch::statistics::{median, spread};
use calib::calibration::effect_named;
use calib::limits::Limit;

use super::values::values;
use crate::commands::calibrate::limits::number;
use crate::exit::Failure;
use crate::report::{Axis, Plot, Report, ReportTable, Series};

/// Spreads from the median beyond which a device is drawn by itself, and how many of each parameter.
const FAR: f64 = 3.5;
const DOTS: usize = 200;
/// Bars of a histogram.
const BARS: usize = 24;

/// Each parameter's median, spread, the sessions' own error, and its limits.
pub(super) fn distributions(
    report: Report,
    records: &[Record],
    names: &[String],
) -> Result<Report, Failure> {
    let mut table = ReportTable::new([
        "number",
        "parameter",
        "median",
        "spread",
        "session's error",
        "least",
        "greatest",
        "unit",
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
            unit(name),
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

/// The unit of a parameter: biases in SI units, scale factors and misalignments without one, coefficients in their own.
fn unit(name: &str) -> String {
    let (owner, parameter) = name.split_once('.').unwrap_or(("", name));
    match (owner, parameter) {
        ("accel", p) if p.starts_with("b_") => "m/s²".to_owned(),
        ("gyro", p) if p.starts_with("b_") => "rad/s".to_owned(),
        _ => {
            let effect = effect_named(owner);
            let mut params = effect.iter().flat_map(|effect| effect.params());
            let own = params.find(|p| p.name == parameter);
            own.map_or_else(String::new, |p| p.unit.to_string())
        }
    }
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
