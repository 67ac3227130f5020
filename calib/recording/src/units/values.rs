//! Values that no working sensor gives, and values at its rails.

use findings::{Finding, Findings, Kind, OptionName, Remedy};
use std::ops::Range;

use nalgebra::Vector3;
use sensor::Sensor;

use crate::Error;
use crate::readings::{LevelChange, cut_off_at, level_change, only_noise};
use crate::recording::options::Role;
use crate::recording::samples::Samples;
use crate::recording::stream::least_steps;
use crate::shown::figure;
use crate::source::place::{at_line, in_file};
use crate::units::lost_points::lost;
use crate::units::rests::{rests, sphere};
use crate::units::thousands::separated;

findings::tuning! {
    /// Samples from which on statistics mean something.
    pub(crate) ENOUGH: usize = 100;
    /// A zero is another than 0 by this share of gravity.
    FAR: f64 = 0.5;
    /// Samples looked at for it.
    LOOKED_AT: usize = 360_000;
    /// No unit makes a sensor's largest reading smaller.
    TINIEST: f64 = 1e-9;
    /// A step that a 16-bit register can only take by overflowing: from one rail to the other.
    OVERFLOW: f64 = 60_000.0;
}

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
        && samples.t.len() >= ENOUGH.get()
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
        if samples.t.len() >= ENOUGH.get() && low == high {
            let found = of(Kind::AXIS_CONSTANT);
            let found = match sensor {
                Sensor::Gyroscope => found.remedy(accelerometer_alone()),
                _ => found,
            };
            return Err(stuck(name, found, samples, low));
        }
        if let Some(run) = stuck_within(samples, axis) {
            let found = of(Kind::AXIS_STUCK).detail("column", column(sensor, axis));
            return Err(stopped(name, found, samples, axis, run));
        }
        if let Some(first) = separated(samples.values.iter().map(|value| value[axis])) {
            let value = samples.values[first][axis];
            let found = of(Kind::THOUSANDS_BY_POINTS)
                .detail("value", figure(value))
                .detail("thousands", figure(1e3 * value));
            return Err(at_line(name, samples.line(first), found));
        }
        if let Some(found) = lost(samples.values.iter().map(|value| value[axis])) {
            let points = of(Kind::POINTS_LOST)
                .detail("value", figure(found.value))
                .detail("beside", figure(found.beside));
            return Err(at_line(name, samples.line(found.at), points));
        }
        let peak = high.max(-low);
        if peak > 0.0 && peak < TINIEST.get() {
            let tiny = of(Kind::READINGS_TINY).detail("peak", format!("{peak:e}"));
            return Err(in_file(name, tiny));
        }
        if sixteen_bits || unsigned {
            let kind = if unsigned {
                Kind::SIGN_LOST
            } else {
                Kind::OVERFLOW
            };
            refuse_overflow(name, of(kind), samples, axis)?;
        }
        if !is_full_scale(sensor, peak, sixteen_bits) {
            continue;
        }
        let step = least_steps(&samples.values)[axis];
        let rows = [low, high].map(|rail| cut_off_at(&samples.values, axis, step, rail));
        if let Some(rows) = rows.into_iter().max().filter(|&rows| rows > 0) {
            warnings.push(
                Finding::of(Kind::SATURATED)
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
    let values = &values[..values.len().min(LOOKED_AT.get())];
    let means: Vec<_> = rests(values, values)
        .iter()
        .map(|rest| rest.means[0])
        .collect();
    sphere(&means).is_some_and(|(centre, radius)| centre.norm() > FAR.get() * radius)
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
    (samples.t.len() >= ENOUGH.get()).then(|| crate::readings::stuck(&samples.values, axis))?
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
        Some((_, from, to)) => Finding::of(Kind::UNIT_CHANGES)
            .detail("from", from)
            .detail("to", to),
        None => Finding::of(Kind::NORM_CHANGES),
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
    let jump = |w: &[Vector3<f64>]| (w[1][axis] - w[0][axis]).abs() > OVERFLOW.get();
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
