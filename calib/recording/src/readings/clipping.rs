//! Axes that are cut off at the end of their range.

use findings::{Findings, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::excursion::Excursion;
use super::of_sensor::{FIRST_ROW, least_step};
use super::symptom::Symptom;
use crate::recording::Stream;

findings::tuning! {
    /// So many equal readings in a row at an extreme may be a peak that is cut off.
    RUN: usize = 3;
    /// A peak that is cut off is higher than this many least steps: rounding and noise make a round peak flat over less.
    HIGHER: f64 = 4.0;
    /// Readings in such runs below which nothing is said.
    FEWEST: usize = 6;
    /// An interval in which more than this share of the samples is cut off has no mean.
    MOST_CLIPPED: f64 = 0.02;
    /// An axis whose readings repeat in more than this share elsewhere is coarse, and repeats at its peaks too.
    REPEATS: f64 = 0.2;
}

/// Lower and upper reading at which an axis is cut off; infinite where it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Limits {
    /// The reading below which there is none.
    low: f64,
    /// The reading above which there is none.
    high: f64,
}

impl Limits {
    /// Returns true if a reading lies at a limit.
    fn reached(&self, value: f64) -> bool {
        value <= self.low || value >= self.high
    }
}

/// The range of a sensor as its readings show it.
#[derive(Clone, Copy, Debug)]
pub struct Range([Limits; 3]);

impl Range {
    /// Looks for the ends of all axes in a sensor's readings (`n × 3`).
    pub fn of(values: &[Vector3<f64>]) -> Self {
        Self([0, 1, 2].map(|axis| limits(values, axis)))
    }

    /// Returns the axis of which so many of these samples are cut off that they have no mean.
    pub fn spoils(&self, samples: &[Vector3<f64>]) -> Option<usize> {
        let is_spoilt = |axis: &usize| {
            let reached = samples.iter().filter(|v| self.0[*axis].reached(v[*axis]));
            reached.count() as f64 > MOST_CLIPPED.get() * samples.len() as f64
        };
        (0..3).find(is_spoilt)
    }
}

/// The limits of an axis that its readings show.
fn limits(values: &[Vector3<f64>], axis: usize) -> Limits {
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
    let coarse = equal as f64 > REPEATS.get() * all as f64;
    let step = least_step(values, axis).unwrap_or(0.0);
    let cut_off =
        |limit: f64| !coarse && low < high && cut_off_at(values, axis, step, limit) >= FEWEST.get();
    let found = [low, high].map(|limit| cut_off(limit).then_some(limit));
    let [low, high] = match found {
        [None, None] => found,
        _ => Excursion::of(values).ends(axis, found),
    };
    Limits {
        low: low.unwrap_or(f64::NEG_INFINITY),
        high: high.unwrap_or(f64::INFINITY),
    }
}

/// Number of rows of an axis at `limit` that stand in runs of three or more and cut off a peak.
///
/// A parabola that is cut off over `n` rows and left by `s` a row is `n s / 4` higher; of `s` a least step may be rounding. A row that
/// repeats all axes of the one before was read too early, and counts for none.
pub(crate) fn cut_off_at(values: &[Vector3<f64>], axis: usize, step: f64, limit: f64) -> usize {
    // Most recordings reach their extreme once or twice.
    if values.iter().filter(|value| value[axis] == limit).count() < RUN.get() {
        return 0;
    }
    let is_new = |k: &usize| {
        k.checked_sub(1)
            .is_none_or(|before| values[before] != values[*k])
    };
    let column: Vec<f64> = (0..values.len())
        .filter(is_new)
        .map(|k| values[k][axis])
        .collect();
    let (mut total, mut first) = (0, 0);
    for run in column.chunk_by(|a, b| (*a == limit) == (*b == limit)) {
        let (begin, end) = (first, first + run.len());
        first = end;
        if run[0] != limit || run.len() < RUN.get() {
            continue;
        }
        let beside = [begin.checked_sub(1), Some(end)].into_iter().flatten();
        let leaps: Vec<f64> = beside
            .filter_map(|k| Some(((column.get(k)? - limit).abs() - step).max(0.0)))
            .collect();
        let slope = leaps.iter().sum::<f64>() / leaps.len().max(1) as f64;
        if 0.25 * run.len() as f64 * slope > HIGHER.get() * step {
            total += run.len();
        }
    }
    total
}

/// The axes that are cut off, those that the reader has named left out.
pub(super) fn found(sensor: Sensor, stream: &Stream, said: &Findings) -> Vec<Symptom> {
    let values = &stream.values;
    let one = |axis: usize| {
        let limits = limits(values, axis);
        let limit = [limits.low, limits.high]
            .into_iter()
            .find(|l| l.is_finite())?;
        let at: Vec<usize> = (0..values.len())
            .filter(|&k| limits.reached(values[k][axis]))
            .collect();
        Some(Symptom::Clipped {
            sensor,
            axis,
            limit,
            rows: at.len(),
            from_row: at.first()? + FIRST_ROW,
            to_row: at.last()? + FIRST_ROW,
        })
    };
    let named = |axis: usize| {
        said.iter().any(|own| {
            own.kind == Kind::SATURATED
                && own.place.sensor == Some(sensor)
                && own.word("axis") == Some(["x", "y", "z"][axis])
        })
    };
    (0..3).filter(|&k| !named(k)).filter_map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Rows at the top of a turn, read in steps of `step` with noise of one step and cut off at `limit`.
    fn at_the_top(step: f64, limit: f64) -> usize {
        let value = |k: usize| {
            let noise = ((k * 7919) % 101) as f64 / 101.0 - 0.5;
            let rate = (4.3 * (0.03 * k as f64).sin() + 2.0 * step * noise).min(limit);
            Vector3::new((rate / step).round() * step, 0.1 * k as f64, 0.0)
        };
        let values: Vec<_> = (0..120).map(value).collect();
        let high = values.iter().map(|v| v.x).fold(f64::MIN, f64::max);
        cut_off_at(&values, 0, step, high)
    }

    #[test]
    fn a_turn_that_is_cut_off_is_at_the_limit_and_a_round_peak_of_coarse_readings_is_not() {
        assert!(at_the_top(1e-4, 4.0) > 10);
        for step in [2e-3, 5e-3, 0.01, 0.02, 0.05, 1.0] {
            assert_eq!(at_the_top(step, 10.0), 0, "{step}");
        }
    }

    #[test]
    fn a_row_that_repeats_all_axes_is_no_longer_at_the_limit_for_it() {
        let row = |x: f64| Vector3::new(x, 2.0 * x, 0.0);
        let rows = [1.0, 3.0, 4.3, 4.3, 4.3, 3.0, 1.0].map(row);
        assert_eq!(cut_off_at(&rows, 0, 0.1, 4.3), 0);
        let mut others = rows;
        others[3].z = 1.0;
        others[4].z = 2.0;
        assert_eq!(cut_off_at(&others, 0, 0.1, 4.3), 3);
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
        let found = |said: &Findings| found(Sensor::Gyroscope, &stream, said);
        let said = |sensor: Sensor, axis: &str| -> Findings {
            let one = findings::Finding::of(Kind::SATURATED);
            vec![one.of_sensor(sensor).detail("axis", axis)].into()
        };
        assert_eq!(found(&Findings::new()).len(), 1);
        assert_eq!(found(&said(Sensor::Gyroscope, "y")).len(), 1);
        assert_eq!(found(&said(Sensor::Accelerometer, "x")).len(), 1);
        assert_eq!(found(&said(Sensor::Gyroscope, "x")).len(), 0);
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
