//! Samples of one sensor.

use std::ops::Range;

use nalgebra::Vector3;

use crate::order_statistic::nth_smallest;

findings::tuning! {
    /// Stamps closer than this are one instant, s: more than rounding does to a stamp, less than any
    /// sampling step. Windows of whole steps begin and end at stamps; without this, rounding would decide
    /// which of them hold a sample more, and a clock that starts elsewhere would give another result.
    pub INSTANT: f64 = 1e-6;
}

/// Returns true if stamp `t` is before the instant `time`, both in s, by more than [`INSTANT`].
pub fn is_before(t: f64, time: f64) -> bool {
    t < time - INSTANT.get()
}

/// Samples of a three-axis sensor with their own time stamps.
///
/// `t` is strictly increasing and as long as `values`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stream {
    /// Time stamps, s.
    pub t: Vec<f64>,
    /// Samples, in the sensor's unit.
    pub values: Vec<Vector3<f64>>,
}

impl Stream {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// True without samples.
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// First and last stamp, s; `None` without samples.
    pub fn span(&self) -> Option<(f64, f64)> {
        Some((*self.t.first()?, *self.t.last()?))
    }

    /// Median time between samples, s; `None` with fewer than two.
    pub fn median_step(&self) -> Option<f64> {
        median_step(&self.t)
    }

    /// Returns the interruptions of the samples: steps longer than five times the 95th percentile of all steps. (The median would not
    /// do: stamps that come in bursts have tiny medians and no interruptions.)
    pub fn gaps(&self) -> Vec<Gap> {
        // Between steps as even as those of most recordings the percentile need not be looked for.
        let even = |&(least, largest): &(f64, f64)| largest <= 5.0 * least + INSTANT.get();
        if extreme_steps(&self.t).as_ref().is_none_or(even) {
            return Vec::new();
        }
        let rank = (self.t.len() - 2) * 19 / 20;
        let Some(usual) = nth_smallest(steps(&self.t), rank) else {
            return Vec::new();
        };
        let pairs = self.t.windows(2).enumerate();
        pairs
            .filter(|(_, pair)| pair[1] - pair[0] > 5.0 * usual + INSTANT.get())
            .map(|(after, pair)| Gap {
                after,
                t0: pair[0],
                t1: pair[1],
            })
            .collect()
    }

    /// The reading at time `t`, linear between samples and constant outside; `None` without samples.
    pub fn at(&self, t: f64) -> Option<Vector3<f64>> {
        let after = self.t.partition_point(|&s| s < t);
        if after == 0 {
            return self.values.first().copied();
        }
        let Some((&t1, v1)) = self.t.get(after).zip(self.values.get(after)) else {
            return self.values.last().copied();
        };
        let (t0, v0) = (self.t[after - 1], self.values[after - 1]);
        Some(v0 + (v1 - v0) * ((t - t0) / (t1 - t0)))
    }

    /// The smallest step between neighbouring readings of each axis: the least significant bit of a
    /// quantised sensor. Infinite where the axis never changes.
    pub fn least_steps(&self) -> [f64; 3] {
        least_steps(&self.values)
    }

    /// The samples with `from <= t < to`, up to what rounding does to a stamp.
    pub fn between(&self, from: f64, to: f64) -> Range<usize> {
        let start = self.t.partition_point(|&t| is_before(t, from));
        let end = self.t.partition_point(|&t| is_before(t, to));
        start..end.max(start)
    }
}

/// An interruption of a stream.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Index of the last sample before it.
    pub after: usize,
    /// Stamp of the last sample before it, s.
    pub t0: f64,
    /// Stamp of the first sample after it, s.
    pub t1: f64,
}

fn steps(t: &[f64]) -> impl Iterator<Item = f64> + Clone {
    t.windows(2).map(|pair| pair[1] - pair[0])
}

/// The least and the largest difference of neighbours; `None` with fewer than two.
pub(crate) fn extreme_steps(t: &[f64]) -> Option<(f64, f64)> {
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    let extremes = steps(t).fold(none, |(least, largest), step| {
        let least = if step < least { step } else { least };
        (least, if step > largest { step } else { largest })
    });
    (t.len() >= 2).then_some(extremes)
}

/// The smallest step between neighbouring readings of each axis; infinite where it never changes.
pub(crate) fn least_steps(values: &[Vector3<f64>]) -> [f64; 3] {
    let mut least = [f64::INFINITY; 3];
    for pair in values.windows(2) {
        for (axis, least) in least.iter_mut().enumerate() {
            let step = (pair[1][axis] - pair[0][axis]).abs();
            if step > 0.0 && step < *least {
                *least = step;
            }
        }
    }
    least
}

/// The median difference of neighbours; `None` with fewer than two.
pub(crate) fn median_step(t: &[f64]) -> Option<f64> {
    nth_smallest(steps(t), t.len().saturating_sub(1) / 2)
}

/// Temperature readings with their own time stamps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Temperature {
    /// Time stamps, s.
    pub t: Vec<f64>,
    /// Readings, °C.
    pub celsius: Vec<f64>,
}

impl Temperature {
    /// The temperature at time `t`, linear between readings and constant outside; `None` without
    /// readings.
    pub fn at(&self, t: f64) -> Option<f64> {
        let after = self.t.partition_point(|&s| s < t);
        if after == 0 {
            return self.celsius.first().copied();
        }
        let Some((&t1, &c1)) = self.t.get(after).zip(self.celsius.get(after)) else {
            return self.celsius.last().copied();
        };
        let (t0, c0) = (self.t[after - 1], self.celsius[after - 1]);
        Some(c0 + (c1 - c0) * (t - t0) / (t1 - t0))
    }

    /// The mean of the readings from `from` to `to`; between the readings about it where it holds none.
    pub fn mean(&self, from: f64, to: f64) -> Option<f64> {
        let first = self.t.partition_point(|&s| is_before(s, from));
        let end = self.t.partition_point(|&s| !is_before(to, s));
        match self.celsius.get(first..end) {
            Some(readings) if !readings.is_empty() => {
                Some(readings.iter().sum::<f64>() / readings.len() as f64)
            }
            _ => self.at(0.5 * (from + to)),
        }
    }
}
