//! Two axes of a sensor that hold the same readings: one of them is lost.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;
use sensor::Sensor;

use super::values::ENOUGH;
use crate::Error;
use crate::recording::options::Role;
use crate::recording::samples::Samples;
use crate::shown::figure;
use crate::source::place::at_line;

findings::tuning! {
    /// An axis is a multiple of another where it differs by no more than this share of its range, ...
    EXACT: f64 = 1e-6;
    /// ... or than rounding of both makes of it, where its range is so many steps.
    ROUNDED: f64 = 0.75;
    /// Steps of its range from which rounding counts.
    STEPS: f64 = 100.0;
}

/// An axis that is `factor` times another, and a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Repeat {
    axis: usize,
    of: usize,
    factor: f64,
}

/// Refuses a sensor of which an axis repeats another in every row.
///
/// # Errors
/// [`Error::Input`] with the two columns.
pub(crate) fn refuse(name: &str, sensor: Sensor, samples: &Samples) -> Result<(), Error> {
    let found: Vec<Repeat> = repeats(&samples.values);
    let Some(first) = found.first() else {
        return Ok(());
    };
    let called = |axis: usize| Role::axis(sensor, axis).name();
    let said: Vec<String> = found
        .iter()
        .map(|repeat| {
            let times = match repeat.factor {
                f if (f - 1.0).abs() < EXACT.get() => String::new(),
                f if (f + 1.0).abs() < EXACT.get() => "-1 times ".to_owned(),
                f => format!("{} times ", figure((f * 1e4).round() / 1e4)),
            };
            format!("{} is {times}{}", called(repeat.axis), called(repeat.of))
        })
        .collect();
    let axes: Vec<&str> = found.iter().map(|repeat| called(repeat.axis)).collect();
    let verb = if found.len() > 1 { "are" } else { "is" };
    let axes = format!("{} {verb}", axes.join(" and "));
    Err(at_line(
        name,
        samples.line(0),
        Finding::of(Kind::AXIS_REPEATED)
            .of_sensor(sensor)
            .detail("repeated", said.join(" and "))
            .detail("axes", axes)
            .remedy(Remedy::such_as(
                OptionName::Columns,
                format!("{}=NAME", called(first.axis)),
            )),
    ))
}

/// Axes that repeat one before them.
fn repeats(values: &[Vector3<f64>]) -> Vec<Repeat> {
    if values.len() < ENOUGH.get() {
        return Vec::new();
    }
    let of = |axis: usize| (0..axis).find_map(|of| repeat(values, of, axis));
    [1, 2].into_iter().filter_map(of).collect()
}

fn repeat(values: &[Vector3<f64>], of: usize, axis: usize) -> Option<Repeat> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<Vector3<f64>>() / count;
    let (mut between, mut own) = (0.0, 0.0);
    for value in values {
        let from = value - mean;
        between += from[of] * from[axis];
        own += from[of] * from[of];
    }
    let factor = between / own;
    if !factor.is_finite() || factor == 0.0 {
        return None;
    }
    let range = |axis: usize| {
        let column = || values.iter().map(|value| value[axis]);
        column().fold(f64::MIN, f64::max) - column().fold(f64::MAX, f64::min)
    };
    let step = |axis: usize| {
        let changes = values
            .windows(2)
            .map(|pair| (pair[1][axis] - pair[0][axis]).abs());
        changes.filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min)
    };
    let (range, steps) = (range(axis), [step(axis), factor.abs() * step(of)]);
    let rounding = match range > STEPS.get() * steps[0].max(steps[1]) {
        true => ROUNDED.get() * (steps[0] + steps[1]),
        false => 0.0,
    };
    let allowed = (EXACT.get() * range).max(rounding);
    let off =
        |value: &Vector3<f64>| (value[axis] - mean[axis] - factor * (value[of] - mean[of])).abs();
    (range > 0.0 && values.iter().all(|value| off(value) <= allowed)).then_some(Repeat {
        axis,
        of,
        factor,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings() -> Vec<Vector3<f64>> {
        let value = |k: usize, i: usize| {
            let t = k as f64;
            let v = (0.01 * t * (i + 1) as f64).sin() + 0.01 * ((k * k * (i + 3)) as f64).sin();
            (v * 1e4).round() / 1e4
        };
        (0..500)
            .map(|k| Vector3::from_fn(|i, _| value(k, i)))
            .collect()
    }

    #[test]
    fn an_axis_that_repeats_another_is_found_negated_scaled_and_rounded() {
        assert_eq!(repeats(&readings()), []);
        for (axis, of) in [(1, 0), (2, 0), (2, 1)] {
            for factor in [1.0, -1.0, 2.0, 0.37] {
                let mut values = readings();
                for value in &mut values {
                    value[axis] = (factor * value[of] * 1e4).round() / 1e4;
                }
                let found = repeats(&values);
                assert!(
                    found.len() == 1 && found[0].axis == axis && found[0].of == of,
                    "{found:?}"
                );
                assert!((found[0].factor - factor).abs() < 1e-3, "{found:?}");
            }
        }
    }

    #[test]
    fn coarse_readings_that_hardly_move_do_not_repeat_each_other() {
        let value = |k: usize, i: usize| ((k * (i + 3)) % 3) as f64;
        let values: Vec<_> = (0..300)
            .map(|k| Vector3::from_fn(|i, _| value(k, i)))
            .collect();
        assert_eq!(repeats(&values), []);
    }
}
