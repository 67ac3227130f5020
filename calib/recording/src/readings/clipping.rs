//! Axes that are cut off at the end of their range.

use findings::{Findings, Kind};
use nalgebra::Vector3;

use super::excursion::Excursion;
use super::of_sensor::{FIRST_ROW, OfSensor};
use super::symptom::Symptom;

/// So many equal readings in a row at an extreme are no peak.
const RUN: usize = 3;
/// Readings in such runs below which nothing is said.
const FEWEST: usize = 6;
/// An axis whose readings repeat in more than this share elsewhere is coarse, and repeats at its peaks too.
const REPEATS: f64 = 0.2;

/// Lower and upper reading at which an axis is cut off; infinite where it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    /// The reading below which there is none.
    pub low: f64,
    /// The reading above which there is none.
    pub high: f64,
}

impl Limits {
    /// Returns true if a reading lies at a limit.
    pub fn reached(&self, value: f64) -> bool {
        value <= self.low || value >= self.high
    }
}

/// The limits of an axis that its readings show.
pub(crate) fn limits(values: &[Vector3<f64>], axis: usize) -> Limits {
    let column = || values.iter().map(move |v| v[axis]);
    let low = column().fold(f64::INFINITY, f64::min);
    let high = column().fold(f64::NEG_INFINITY, f64::max);
    let inside = values.windows(2).filter(|pair| {
        let (a, b) = (pair[0][axis], pair[1][axis]);
        a > low && a < high && b > low && b < high
    });
    let (mut all, mut equal) = (0usize, 0usize);
    for pair in inside {
        all += 1;
        equal += usize::from(pair[0][axis] == pair[1][axis]);
    }
    let coarse = equal as f64 > REPEATS * all as f64;
    let is_far = |limit: f64| Excursion::of(values).reached(axis, limit);
    let cut_off =
        |limit: f64| !coarse && low < high && in_runs(column(), limit) >= FEWEST && is_far(limit);
    Limits {
        low: if cut_off(low) { low } else { f64::NEG_INFINITY },
        high: if cut_off(high) { high } else { f64::INFINITY },
    }
}

/// Number of the values equal to `limit` that stand in runs.
fn in_runs(values: impl Iterator<Item = f64>, limit: f64) -> usize {
    let (mut total, mut run) = (0, 0);
    for value in values.chain([f64::NAN]) {
        if value == limit {
            run += 1;
        } else {
            total += if run >= RUN { run } else { 0 };
            run = 0;
        }
    }
    total
}

/// The axes that are cut off, those that the reader has named left out.
pub(super) fn found(of: &OfSensor<'_>, said: &Findings) -> Vec<Symptom> {
    let values = &of.stream.values;
    let one = |axis: usize| {
        let limits = limits(values, axis);
        let limit = [limits.low, limits.high]
            .into_iter()
            .find(|l| l.is_finite())?;
        let at: Vec<usize> = (0..values.len())
            .filter(|&k| limits.reached(values[k][axis]))
            .collect();
        Some(Symptom::Clipped {
            sensor: of.sensor,
            axis,
            limit,
            rows: at.len(),
            from_row: at.first()? + FIRST_ROW,
            to_row: at.last()? + FIRST_ROW,
        })
    };
    let named = |axis: usize| {
        said.iter().any(|own| {
            own.kind == Kind::Saturated
                && own.place.sensor == Some(of.sensor)
                && own.word("axis") == Some(["x", "y", "z"][axis])
        })
    };
    (0..3).filter(|&k| !named(k)).filter_map(one).collect()
}

#[cfg(test)]
mod tests {
    use sensor::Sensor;

    use super::*;
    use crate::recording::Stream;

    fn wave(limit: f64, step: f64) -> Vec<Vector3<f64>> {
        let value = |k: usize| {
            let v = 10.0 * (0.05 * k as f64).sin() + ((k * k % 97) as f64) * 1e-3;
            let v = if step > 0.0 {
                (v / step).round() * step
            } else {
                v
            };
            Vector3::new(v.min(limit), v, 0.5 * v)
        };
        (0..2000).map(value).collect()
    }

    #[test]
    fn a_reading_that_repeats_at_rest_is_no_limit_though_none_is_lower() {
        let value = |k: usize| {
            let turns = f64::max(0.0, (0.01 * k as f64).sin() - 0.5);
            let rate = 4.0 * turns - 0.027 + ((k * k % 97) as f64) * 2e-5;
            Vector3::repeat((rate / 0.04).round() * 0.04)
        };
        let coarse: Vec<_> = (0..4000).map(value).collect();
        assert_eq!(limits(&coarse, 0).low, f64::NEG_INFINITY);
    }

    #[test]
    fn an_axis_that_the_reader_has_named_is_not_named_again() {
        let stream = Stream {
            t: (0..2000).map(f64::from).collect(),
            values: wave(8.0, 0.0),
        };
        let of = OfSensor {
            sensor: Sensor::Gyroscope,
            stream: &stream,
            moments: Vec::new(),
            statics: &[],
        };
        let said = |sensor: Sensor, axis: &str| -> Findings {
            let one = findings::Finding::of(Kind::Saturated);
            vec![one.of_sensor(sensor).detail("axis", axis)].into()
        };
        assert_eq!(found(&of, &Findings::new()).len(), 1);
        assert_eq!(found(&of, &said(Sensor::Gyroscope, "y")).len(), 1);
        assert_eq!(found(&of, &said(Sensor::Accelerometer, "x")).len(), 1);
        assert_eq!(found(&of, &said(Sensor::Gyroscope, "x")).len(), 0);
    }

    #[test]
    fn a_flat_top_is_a_limit_and_a_round_or_coarse_one_is_not() {
        let fine = wave(8.0, 0.0);
        assert_eq!(limits(&fine, 0).high, 8.0);
        assert!(!limits(&fine, 0).low.is_finite());
        assert!(!limits(&fine, 1).high.is_finite());
        assert!(!limits(&wave(20.0, 4.0), 0).high.is_finite());
    }
}
