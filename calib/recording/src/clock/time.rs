//! From stamps in the file's unit to seconds.

use crate::Error;
use crate::recording::options::ReadOptions;
use crate::rows::table::Table;
use crate::shown::figure;
use crate::source::place::in_file;
use crate::units::TimeUnit;

/// Rates that a unit in the file may mean, Hz.
const POSSIBLE: std::ops::RangeInclusive<f64> = 0.2..=60_000.0;

/// Turns the stamps of every table, on one clock and in one unit, into seconds.
pub(crate) fn to_seconds(
    tables: &mut [Table],
    options: &ReadOptions,
    warnings: &mut Vec<String>,
) -> Result<(), Error> {
    let Some(first) = tables.first() else {
        return Ok(());
    };
    let unit = unit(first, options, warnings)?;
    for table in tables {
        if let Some(line) = table.clock.wraps.first() {
            let count = table.clock.wraps.len();
            warnings.push(format!(
                "{}:{line}: the time counter starts again, {count} times in all; counted on",
                table.name
            ));
        }
        let per_second = unit.per_second();
        if per_second != 1.0 {
            let columns = table.stamps_mut().into_iter();
            columns.flatten().for_each(|t| *t /= per_second);
        }
    }
    Ok(())
}

/// The unit that was given, or stated, or follows from an epoch or from the rate.
fn unit(
    table: &Table,
    options: &ReadOptions,
    warnings: &mut Vec<String>,
) -> Result<TimeUnit, Error> {
    if table.clock.dates {
        return Ok(TimeUnit::Nanoseconds);
    }
    if let Some(unit) = options.time_unit {
        return Ok(unit);
    }
    let step = usual_step(table);
    if let Some(unit) = table.stated.time {
        let rate = step.map(|step| unit.per_second() / step);
        return match rate.filter(|rate| !POSSIBLE.contains(rate)) {
            None => Ok(unit),
            Some(rate) => {
                // Another in which the rate is one of a sensor.
                let step = step.unwrap_or(1.0);
                let usual =
                    |unit: &&TimeUnit| (10.0..=2000.0).contains(&(unit.per_second() / step));
                let other = TimeUnit::ALL
                    .iter()
                    .find(usual)
                    .unwrap_or(&TimeUnit::Seconds);
                Err(in_file(
                    &table.name,
                    format!(
                        "the file states {} for the time, in which the rate would be {} Hz; say the unit, as in --time-unit {}",
                        unit.name(),
                        figure(rate),
                        other.name()
                    ),
                ))
            }
        };
    }
    let Some(step) = step else {
        return Ok(TimeUnit::Seconds);
    };
    let plausible = |unit: &TimeUnit| (1.0..=10_000.0).contains(&(unit.per_second() / step));
    // A counter of microseconds looks like seconds of this century after half an hour: its rate tells.
    if let Some(unit) = table.clock.origin.and_then(of_epoch).filter(plausible) {
        if unit != TimeUnit::Seconds {
            warnings.push(decided(table, unit, "stamps are of this century"));
        }
        return Ok(unit);
    }
    if plausible(&TimeUnit::Seconds) {
        if step == 1.0 {
            warnings.push(format!(
                "{}: stamps go up by 1, read as seconds; if they count samples say --rate, if they are milliseconds --time-unit ms",
                table.name
            ));
        }
        return Ok(TimeUnit::Seconds);
    }
    let fitting: Vec<TimeUnit> = TimeUnit::ALL.into_iter().filter(plausible).collect();
    match fitting[..] {
        [unit] => {
            warnings.push(decided(
                table,
                unit,
                &format!("a rate of {:.0} Hz", unit.per_second() / step),
            ));
            Ok(unit)
        }
        [] if table.plain_time => Ok(TimeUnit::Seconds),
        _ => {
            // Days since 1900, or since the year 0.
            let samples = [&table.accel, &table.gyro];
            let first = samples.into_iter().find_map(|samples| samples.t.first());
            let is_days =
                first.is_some_and(|first| (1e4..1e6).contains(first)) && plausible(&TimeUnit::Days);
            Err(in_file(
                &table.name,
                format!(
                    "the usual step between stamps is {}: say the unit, as in --time-unit {}",
                    figure(step),
                    if is_days { "d" } else { "ms" }
                ),
            ))
        }
    }
}

fn decided(table: &Table, unit: TimeUnit, why: &str) -> String {
    format!(
        "{}: time taken as {} ({why}); --time-unit overrides",
        table.name,
        unit.name()
    )
}

/// The unit in which `stamp` lies between 2001 and 2100.
fn of_epoch(stamp: i64) -> Option<TimeUnit> {
    let years = 978_307_200.0..4_102_444_800.0;
    TimeUnit::ALL
        .into_iter()
        .find(|u| years.contains(&(stamp as f64 / u.per_second())))
}

/// The median step of the sensor with more samples.
fn usual_step(table: &Table) -> Option<f64> {
    let longer = if table.accel.t.len() >= table.gyro.t.len() {
        &table.accel
    } else {
        &table.gyro
    };
    crate::recording::stream::median_step(&longer.t)
}
