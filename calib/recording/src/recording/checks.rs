//! Stamps and temperatures that are refused, or worth a warning.

use findings::{Finding, Findings, Kind, OptionName, Remedy, Setting};
use sensor::Sensor;

use super::options::{ReadOptions, Role};
use super::samples::Samples;
use super::stream::extreme_steps;
use super::temperature_counts::Offered;
use super::{Gap, Stream, temperature_counts};
use crate::Error;
use crate::clock::even::Bursts;
use crate::header::suggest::entry;
use crate::rows::table::Table;
use crate::shown::significant;
use crate::source::place::in_file;
use crate::units::TemperatureUnit;

/// Repeated rows and equal stamps.
pub(crate) fn order(name: &str, samples: &Samples, warnings: &mut Findings) -> Result<(), Error> {
    let repeats = samples.repeats;
    if repeats.count > 0 {
        warnings.push(
            Finding::of(Kind::ROWS_REPEATED)
                .in_recording(name)
                .count("count", repeats.count)
                .count("first_line", repeats.first as usize)
                .count("last_line", repeats.last as usize),
        );
    }
    let merged = samples.other_twins().count();
    if samples.t.len() < 2 && merged + repeats.count > 0 {
        return Err(in_file(name, Finding::of(Kind::STAMPS_ALL_EQUAL)));
    }
    if merged > samples.t.len() {
        return Err(in_file(
            name,
            Finding::of(Kind::STAMPS_TOO_COARSE)
                .count("merged", merged)
                .count("all", merged + samples.t.len()),
        ));
    }
    if merged > 0 {
        let equal = Finding::of(Kind::STAMPS_EQUAL).in_recording(name);
        warnings.push(equal.count("count", merged));
    }
    Ok(())
}

findings::tuning! {
    /// Parts of the steps that are looked at one by one, and their least and largest length: in most of them short steps are among
    /// longer ones where samples arrive in bursts. A sampling that changes its rate has even steps in each.
    PARTS: usize = 16;
}

const PART: std::ops::RangeInclusive<usize> = 64..=512;

findings::tuning! {
    /// No sampling changes its rate so much that the mean step is so many times the median: stamps do, in another unit say.
    NO_RATE: f64 = 50.0;
}

/// Stamps of arrival instead of sampling: most steps far shorter than the mean.
pub(crate) fn bursts(
    name: &str,
    sensor: Sensor,
    stream: &Stream,
    gaps: &[Gap],
    behind: Option<&Bursts>,
    warnings: &mut Findings,
) {
    let (Some((least, _)), [first, .., last]) = (extreme_steps(&stream.t), &stream.t[..]) else {
        return;
    };
    let missing: f64 = gaps.iter().map(|gap| gap.t1 - gap.t0).sum();
    let mean = (last - first - missing) / (stream.len() - 1 - gaps.len()).max(1) as f64;
    let in_bursts = |step: &f64| *step < mean / 2.0;
    // No median is below the least.
    let median = Some(least).filter(in_bursts).and(stream.median_step());
    let is_of_stamps = |median: &f64| {
        mean > NO_RATE.get() * median || short_steps_are_among_longer_ones(stream, gaps)
    };
    let median = median.filter(in_bursts).filter(is_of_stamps);
    if let Some(median) = median {
        let step = behind.map_or(mean, |found| found.step);
        let rate = significant(1.0 / step, 6);
        warnings.push(
            Finding::of(Kind::STAMPS_OF_ARRIVAL)
                .in_recording(name)
                .of_sensor(sensor)
                .number("median", median, "s")
                .number("mean", mean, "s")
                .remedy(Remedy::set_to(OptionName::Rate, rate)),
        );
    }
}

/// Returns true if in most parts of a stream most steps are far shorter than the mean of that part.
fn short_steps_are_among_longer_ones(stream: &Stream, gaps: &[Gap]) -> bool {
    let is_usual = |&k: &usize| gaps.binary_search_by_key(&k, |gap| gap.after).is_err();
    let usual = (0..stream.len().saturating_sub(1)).filter(is_usual);
    let steps: Vec<f64> = usual.map(|k| stream.t[k + 1] - stream.t[k]).collect();
    let length = (steps.len() / PARTS.get()).clamp(*PART.start(), *PART.end());
    let has_short_ones = |part: &&[f64]| {
        let mean = part.iter().sum::<f64>() / part.len() as f64;
        part.iter().filter(|step| **step < mean / 2.0).count() > part.len() / 2
    };
    let parts = steps.chunks(length);
    2 * parts.clone().filter(has_short_ones).count() > parts.len()
}

/// Interruptions.
pub(crate) fn gaps(name: &str, sensor: Sensor, gaps: &[Gap], warnings: &mut Findings) {
    let longest = gaps
        .iter()
        .max_by(|a, b| (a.t1 - a.t0).total_cmp(&(b.t1 - b.t0)));
    if let Some(longest) = longest {
        let missing = gaps.iter().map(|gap| gap.t1 - gap.t0).sum();
        warnings.push(
            Finding::of(Kind::SAMPLES_LOST)
                .in_recording(name)
                .of_sensor(sensor)
                .between(longest.t0, longest.t1)
                .count("count", gaps.len())
                .number("longest", longest.t1 - longest.t0, "s")
                .number("missing", missing, "s"),
        );
    }
}

findings::tuning! {
    /// Sensors are hardly ever hotter than this, °C: those that are heated against drift stay below it.
    HOT: f64 = 62.0;
}

/// The readings of a thermometer in °C; none, and a warning that says what would make them °C, where they are none.
pub(crate) fn celsius(
    table: &Table,
    options: &ReadOptions,
    warnings: &mut Findings,
) -> Option<Vec<f64>> {
    let (name, readings) = (&table.name, &table.temperature);
    let stated = table.stated.temperature;
    let unit = stated.unwrap_or(TemperatureUnit::Celsius);
    let celsius: Vec<f64> = readings.iter().map(|&r| unit.celsius(r)).collect();
    let possible = celsius.iter().all(|c| (-60.0..=150.0).contains(c));
    let least = celsius.iter().copied().fold(f64::INFINITY, f64::min);
    let most = celsius.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let made = table
        .roles
        .iter()
        .any(|(role, _)| *role == Role::Temperature && options.columns.makes(*role));
    let counts = stated == Some(TemperatureUnit::Counts) && !made;
    let jumps = possible && stated.is_none() && !made && temperature_counts::jump(readings);
    if possible && !counts && !jumps {
        if least > HOT.get() {
            let of = |fahrenheit: f64| (fahrenheit - 32.0) / 1.8;
            warnings.push(
                Finding::of(Kind::TEMPERATURE_DOUBTFUL)
                    .in_recording(name)
                    .number("least", least, "1")
                    .number("most", most, "1")
                    .number("least_celsius", of(least), "°C")
                    .number("most_celsius", of(most), "°C"),
            );
        }
        return Some(celsius);
    }
    let kind = match counts || jumps {
        true => Kind::TEMPERATURE_IN_COUNTS,
        false => Kind::TEMPERATURE_IMPOSSIBLE,
    };
    let found = Finding::of(kind)
        .in_recording(name)
        .number("least", least, "1")
        .number("most", most, "1");
    let open = stated.is_none() || counts;
    let offered = open.then(|| temperature_counts::formulas(readings, &entries(table, options)));
    let offered = offered.unwrap_or_default();
    warnings.push(match (&offered[..], open) {
        ([], true) => found.remedy(Remedy::set_to(OptionName::Columns, "temp=NAME/340+36.53")),
        ([], false) => found,
        _ => {
            let made: Vec<String> = offered.iter().map(Offered::in_words).collect();
            let settings = offered.into_iter().map(|offered| Setting {
                option: OptionName::Columns,
                value: Some(offered.entry),
            });
            found
                .detail("formulas", made.join(" or "))
                .only_remedies([Remedy::Set {
                    any_of: settings.collect(),
                }])
        }
    });
    None
}

/// The entries of `--columns` that read this table as it is read, the temperature's last.
fn entries(table: &Table, options: &ReadOptions) -> String {
    let temperature = table
        .roles
        .iter()
        .find(|(role, _)| *role == Role::Temperature);
    let column = temperature.map_or("NAME", |(_, name)| name);
    let at = table.names.iter().position(|name| name == column);
    let own = at.map_or_else(|| column.to_owned(), |at| entry(&table.names, at));
    let is_other = |(role, _): &&(Role, String)| *role != Role::Temperature;
    let others: &[(Role, String)] = match (options.columns.0.is_empty(), table.names.is_empty()) {
        (false, _) => &options.columns.0,
        (true, true) => &table.roles,
        (true, false) => &[],
    };
    let others = others.iter().filter(is_other);
    let others = others.map(|(role, column)| format!("{}={column},", role.name()));
    others.collect::<String>() + "temp=" + &own
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn stream(t: Vec<f64>) -> Stream {
        Stream {
            values: vec![Vector3::zeros(); t.len()],
            t,
        }
    }

    #[test]
    fn a_rate_that_changes_on_the_way_is_no_burst() {
        let warned = |stream: &Stream| {
            let mut warnings = Findings::new();
            bursts("a.csv", Sensor::Gyroscope, stream, &[], None, &mut warnings);
            warnings.iter().count() > 0
        };
        let changing = (0..8000_u32).map(|k| match k.checked_sub(6000) {
            None => 0.01 * f64::from(k),
            Some(slow) => 60.0 + 0.05 * f64::from(slow),
        });
        assert!(!warned(&stream(changing.collect())));
        let by_tens = (0..8000).map(|k| 0.1 * f64::from(k / 10) + 1e-4 * f64::from(k % 10));
        assert!(warned(&stream(by_tens.collect())));
    }
}
