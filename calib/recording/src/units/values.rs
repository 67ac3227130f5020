//! Values that no working sensor gives, and values at its rails.

use findings::{Finding, Findings, Kind, OptionName, Remedy};
use std::ops::Range;

use nalgebra::Vector3;
use sensor::Sensor;

use crate::Error;
use crate::readings::{LevelChange, level_change, only_noise};
use crate::recording::options::Role;
use crate::recording::samples::Samples;
use crate::recording::stream::least_steps;
use crate::shown::figure;
use crate::source::place::{at_line, in_file};
use crate::units::lost_points::lost;
use crate::units::rests::{rests, sphere};
use crate::units::thousands::separated;

/// Samples from which on statistics mean something.
pub(crate) const ENOUGH: usize = 100;
/// A zero is another than 0 by this share of gravity.
const FAR: f64 = 0.5;
/// Samples looked at for it.
const LOOKED_AT: usize = 360_000;
/// No unit makes a sensor's largest reading smaller.
const TINIEST: f64 = 1e-9;
/// A step that a 16-bit register can only take by overflowing: from one rail to the other.
const OVERFLOW: f64 = 60_000.0;
/// Readings leave a round peak by fewer of their least steps.
const LEAP: f64 = 1.5;

/// Checks all samples of a sensor, in the file's unit.
///
/// # Errors
/// [`Error::Input`] for an axis that never changes, is absurdly small, or overflows 16 bits.
pub(crate) fn check(
    name: &str,
    sensor: Sensor,
    samples: &Samples,
    warnings: &mut Findings,
) -> Result<(), Error> {
    if sensor == Sensor::Accelerometer
        && samples.t.len() >= ENOUGH
        && let Some(change) = level_change(&samples.values)
        && !is_about_another_zero(&samples.values)
        && only_noise(&samples.values).is_none()
    {
        return Err(of_another_level(name, samples, &change));
    }
    let sixteen_bits = are_integers(samples.values.iter());
    let unsigned = !sixteen_bits && are_unsigned(samples.values.iter());
    let ranges = ranges(&samples.values);
    for (axis, (low, high)) in ranges.into_iter().enumerate() {
        let of = |kind: Kind| {
            let found = Finding::of(kind).of_sensor(sensor);
            found.detail("axis", ["x", "y", "z"][axis])
        };
        if samples.t.len() >= ENOUGH && low == high {
            let found = of(Kind::AxisConstant);
            let found = match sensor {
                Sensor::Gyroscope => found.remedy(accelerometer_alone()),
                _ => found,
            };
            return Err(stuck(name, found, samples, low));
        }
        if let Some(run) = stuck_within(samples, axis) {
            let found = of(Kind::AxisStuck).detail("column", column(sensor, axis));
            return Err(stopped(name, found, samples, axis, run));
        }
        if let Some(first) = separated(samples.values.iter().map(|value| value[axis])) {
            let value = samples.values[first][axis];
            let found = of(Kind::ThousandsByPoints)
                .detail("value", figure(value))
                .detail("thousands", figure(1e3 * value));
            return Err(at_line(name, samples.line(first), found));
        }
        if let Some(found) = lost(samples.values.iter().map(|value| value[axis])) {
            let points = of(Kind::PointsLost)
                .detail("value", figure(found.value))
                .detail("beside", figure(found.beside));
            return Err(at_line(name, samples.line(found.at), points));
        }
        let peak = high.max(-low);
        if peak > 0.0 && peak < TINIEST {
            let tiny = of(Kind::ReadingsTiny).detail("peak", format!("{peak:e}"));
            return Err(in_file(name, tiny));
        }
        if sixteen_bits || unsigned {
            let kind = if unsigned {
                Kind::SignLost
            } else {
                Kind::Overflow
            };
            refuse_overflow(name, of(kind), samples, axis)?;
        }
        if !is_full_scale(sensor, peak, sixteen_bits) {
            continue;
        }
        let step = least_steps(&samples.values)[axis];
        let rows = [low, high].map(|rail| at_rail(&samples.values, axis, step, rail));
        if let Some(rows) = rows.into_iter().max().filter(|&rows| rows > 0) {
            warnings.push(
                Finding::of(Kind::Saturated)
                    .in_recording(name)
                    .of_sensor(sensor)
                    .detail("axis", ["x", "y", "z"][axis])
                    .number("limit", peak, "file")
                    .count("rows", rows),
            );
        }
    }
    Ok(())
}

/// True for means at rest that lie on one sphere about a zero that is not 0: its norm changes with the attitude alone.
fn is_about_another_zero(values: &[Vector3<f64>]) -> bool {
    let values = &values[..values.len().min(LOOKED_AT)];
    let means: Vec<_> = rests(values, values)
        .iter()
        .map(|rest| rest.means[0])
        .collect();
    sphere(&means).is_some_and(|(centre, radius)| centre.norm() > FAR * radius)
}

/// Smallest and largest value of each axis.
fn ranges(values: &[Vector3<f64>]) -> [(f64, f64); 3] {
    let mut ranges = [(f64::MAX, f64::MIN); 3];
    for value in values {
        for (&v, (low, high)) in value.iter().zip(&mut ranges) {
            *low = if v < *low { v } else { *low };
            *high = if v > *high { v } else { *high };
        }
    }
    ranges
}

/// The way out where the gyroscope cannot be used.
fn accelerometer_alone() -> Remedy {
    Remedy::set_to(OptionName::Sensor, Sensor::Accelerometer.name())
}

fn stuck(name: &str, found: Finding, samples: &Samples, value: f64) -> Error {
    let doubt = if value == 0.0 {
        "disconnected?"
    } else {
        "stuck?"
    };
    let last = samples.line(samples.t.len() - 1);
    at_line(
        name,
        samples.line(0),
        found
            .detail("value", figure(value))
            .count("last", last as usize)
            .detail("doubt", doubt),
    )
}

/// The column of an axis in plain CSV.
fn column(sensor: Sensor, axis: usize) -> &'static str {
    Role::axis(sensor, axis).name()
}

fn stuck_within(samples: &Samples, axis: usize) -> Option<Range<usize>> {
    (samples.t.len() >= ENOUGH).then(|| crate::readings::stuck(&samples.values, axis))?
}

fn stopped(name: &str, found: Finding, samples: &Samples, axis: usize, run: Range<usize>) -> Error {
    at_line(
        name,
        samples.line(run.start),
        found
            .detail("value", figure(samples.values[run.start][axis]))
            .count("last", samples.line(run.end - 1) as usize)
            .count("rows", run.len()),
    )
}

fn of_another_level(name: &str, samples: &Samples, change: &LevelChange) -> Error {
    let ratio = change.before / change.after;
    let is = |factor: f64| (ratio / factor - 1.0).abs() < 0.1;
    let g = crate::units::STANDARD_GRAVITY;
    let units = [
        (g, "m/s²", "g"),
        (1.0 / g, "g", "m/s²"),
        (1e-3 * g, "m/s²", "mg"),
        (1e3 / g, "mg", "m/s²"),
        (1e-3, "g", "mg"),
        (1e3, "mg", "g"),
    ];
    let found = match units.into_iter().find(|(factor, ..)| is(*factor)) {
        Some((_, from, to)) => Finding::of(Kind::UnitChanges)
            .detail("from", from)
            .detail("to", to),
        None => Finding::of(Kind::NormChanges),
    };
    at_line(
        name,
        samples.line(change.at),
        found
            .detail("before", format!("{:.3}", change.before))
            .detail("after", format!("{:.3}", change.after)),
    )
}

fn refuse_overflow(
    name: &str,
    found: Finding,
    samples: &Samples,
    axis: usize,
) -> Result<(), Error> {
    let jump = |w: &[Vector3<f64>]| (w[1][axis] - w[0][axis]).abs() > OVERFLOW;
    let Some(at) = samples.values.windows(2).position(jump) else {
        return Ok(());
    };
    let (from, to) = (samples.values[at][axis], samples.values[at + 1][axis]);
    Err(at_line(
        name,
        samples.line(at + 1),
        found.detail("from", figure(from)).detail("to", figure(to)),
    ))
}

/// Rows of an axis at `rail` that stand in runs of three or more, into or out of which the readings leap: a round peak of coarse
/// readings is left by one step. A row that repeats all axes of the one before was read too early, and counts for none.
fn at_rail(values: &[Vector3<f64>], axis: usize, step: f64, rail: f64) -> usize {
    let (mut total, mut run, mut leaps_in) = (0, 0, false);
    let mut close = |run: usize, leaps: bool| total += if run >= 3 && leaps { run } else { 0 };
    let mut last: Option<&Vector3<f64>> = None;
    for value in values {
        let Some(before) = last.replace(value).filter(|before| *before != value) else {
            continue;
        };
        let leaps = (value[axis] - before[axis]).abs() > LEAP * step;
        match (before[axis] == rail, value[axis] == rail) {
            (_, true) if run == 0 => (run, leaps_in) = (1, leaps),
            (_, true) => run += 1,
            (true, false) => {
                close(run, leaps_in || leaps);
                run = 0;
            }
            (false, false) => {}
        }
    }
    close(run, leaps_in);
    total
}

/// True if `peak` is where sensors of the usual ranges end, within 5 %.
fn is_full_scale(sensor: Sensor, peak: f64, integers: bool) -> bool {
    const G: f64 = crate::units::STANDARD_GRAVITY;
    let near = |scale: f64| (peak / scale - 1.0).abs() < 0.05;
    if integers && peak > 500.0 {
        return [11, 15, 19, 23]
            .into_iter()
            .any(|bits| (peak - 2f64.powi(bits)).abs() <= 1.0);
    }
    match sensor {
        Sensor::Accelerometer => [2.0, 4.0, 8.0, 16.0, 32.0]
            .iter()
            .any(|&r| near(r * G) || near(r)),
        Sensor::Gyroscope => [125.0f64, 250.0, 500.0, 1000.0, 2000.0, 4000.0]
            .iter()
            .any(|r| near(*r) || near(r.to_radians())),
        // Ranges of magnetometers are as many as there are sensors.
        Sensor::Magnetometer => false,
    }
}

/// True if every value is a whole number that 16 bits without a sign can hold.
fn are_unsigned<'a>(mut values: impl Iterator<Item = &'a Vector3<f64>>) -> bool {
    values.all(|value| {
        let fits = |v: &f64| v.fract() == 0.0 && (0.0..=65_535.0).contains(v);
        value.iter().all(fits)
    })
}

/// True if every value is a whole number that 16 bits with a sign can hold.
pub(crate) fn are_integers<'a>(mut values: impl Iterator<Item = &'a Vector3<f64>>) -> bool {
    values.all(|value| {
        value
            .iter()
            .all(|v| v.fract() == 0.0 && v.abs() <= 32_768.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows at the top of a turn, read in steps of `step` and cut off at `limit`.
    fn at_the_top(step: f64, limit: f64) -> usize {
        let value = |k: usize| {
            let rate = (4.3 * (0.03 * k as f64).sin()).min(limit);
            Vector3::new((rate / step).round() * step, 0.1 * k as f64, 0.0)
        };
        let values: Vec<_> = (0..120).map(value).collect();
        let step = least_steps(&values)[0];
        at_rail(&values, 0, step, ranges(&values)[0].1)
    }

    #[test]
    fn a_turn_that_is_cut_off_is_at_the_rail_and_a_round_peak_of_coarse_readings_is_not() {
        assert!(at_the_top(1e-4, 4.0) > 10);
        assert_eq!(at_the_top(0.05, 10.0), 0);
    }

    #[test]
    fn a_row_that_repeats_all_axes_is_no_longer_at_the_rail_for_it() {
        let row = |x: f64| Vector3::new(x, 2.0 * x, 0.0);
        let rows = [1.0, 3.0, 4.3, 4.3, 4.3, 3.0, 1.0].map(row);
        assert_eq!(at_rail(&rows, 0, 0.1, 4.3), 0);
        let mut others = rows;
        others[3].z = 1.0;
        others[4].z = 2.0;
        assert_eq!(at_rail(&others, 0, 0.1, 4.3), 3);
    }
}
