//! Stamps and temperatures that are refused, or worth a warning.

use findings::Findings;
use sensor::Sensor;

use super::options::{ReadOptions, Role};
use super::samples::Samples;
use super::stream::extreme_steps;
use super::{Gap, Stream, temperature_counts};
use crate::Error;
use crate::header::suggest::entry;
use crate::rows::table::Table;
use crate::shown::{figure, significant};
use crate::source::place::in_file;
use crate::units::TemperatureUnit;

/// Repeated rows and equal stamps.
pub(crate) fn order(name: &str, samples: &Samples, warnings: &mut Findings) -> Result<(), Error> {
    let repeats = samples.repeats;
    if repeats.count > 0 {
        warnings.push(format!(
            "{name}:{}: {} rows between lines {} and {} repeat earlier rows, stamp and values; left out",
            repeats.first, repeats.count, repeats.first, repeats.last
        ));
    }
    let merged = samples.other_twins().count();
    if samples.t.len() < 2 && merged + repeats.count > 0 {
        return Err(in_file(
            name,
            "every time stamp is the same; --rate HZ reads the rows as evenly spaced",
        ));
    }
    if merged > samples.t.len() {
        return Err(in_file(
            name,
            format!(
                "{} of {} rows share their stamp with another: stamps are too coarse; --rate HZ reads the rows as evenly spaced",
                merged,
                merged + samples.t.len()
            ),
        ));
    }
    if merged > 0 {
        warnings.push(format!(
            "{name}: {merged} rows with the stamp of another, merged to their mean"
        ));
    }
    Ok(())
}

/// Stamps of arrival instead of sampling: most steps far shorter than the mean.
pub(crate) fn bursts(
    name: &str,
    sensor: Sensor,
    stream: &Stream,
    gaps: &[Gap],
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
    if let Some(median) = median.filter(in_bursts) {
        warnings.push(format!(
            "{name}: stamps of the {} come in bursts (median step {median:.4} s, mean {mean:.4} s), as of arrival; --rate {} reads the rows as evenly spaced",
            sensor.name(),
            significant(1.0 / mean, 6)
        ));
    }
}

/// Interruptions.
pub(crate) fn gaps(name: &str, sensor: Sensor, gaps: &[Gap], warnings: &mut Findings) {
    let longest = gaps
        .iter()
        .max_by(|a, b| (a.t1 - a.t0).total_cmp(&(b.t1 - b.t0)));
    if let Some(longest) = longest {
        warnings.push(format!(
            "{name}: {} gap{} in the {}, the longest {:.3} s from {:.3} s on",
            gaps.len(),
            if gaps.len() == 1 { "" } else { "s" },
            sensor.name(),
            longest.t1 - longest.t0,
            longest.t0
        ));
    }
}

/// Sensors are hardly ever hotter than this, °C: those that are heated against drift stay below it.
const HOT: f64 = 62.0;

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
        if least > HOT {
            let of = |fahrenheit: f64| (fahrenheit - 32.0) / 1.8;
            warnings.push(format!(
                "{name}: temperatures of {least:.1} to {most:.1} are taken as °C: if they are °F ({:.1} to {:.1} °C), call the column \
                 `temp [F]`; if they are right, leave it",
                of(least),
                of(most)
            ));
        }
        return Some(celsius);
    }
    let why = match (counts, jumps) {
        (true, _) => "are counts of the sensor by the column's name, and no °C".to_owned(),
        (_, true) => "jump from row to row as counts of a sensor do, and no °C".to_owned(),
        _ => "are beyond -60 to 150 °C".to_owned(),
    };
    let open = stated.is_none() || counts;
    let offered = open.then(|| temperature_counts::formulas(readings, &entries(table, options)));
    let advice = match offered.flatten() {
        Some(formulas) => format!(
            "the formula of the sensor's data sheet makes °C of them, as in {formulas}"
        ),
        None if open => {
            "the formula of the sensor's data sheet makes them °C, as in --columns temp=NAME/340+36.53, and so does a unit in the column's name, as `temp [K]`".to_owned()
        }
        None => "the unit in the column's name is another, as in `temp [K]`".to_owned(),
    };
    warnings.push(format!(
        "{name}: temperatures of {} to {} {why}, left out; {advice}",
        figure(least),
        figure(most)
    ));
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
