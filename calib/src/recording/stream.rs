//! Samples of one sensor.

use std::ops::Range;

use nalgebra::Vector3;

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

    /// Median time between samples, s; `None` with fewer than two.
    pub fn median_step(&self) -> Option<f64> {
        let mut steps: Vec<f64> = self.t.windows(2).map(|w| w[1] - w[0]).collect();
        let middle = steps.len() / 2;
        (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
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

    /// The samples with `from <= t < to`.
    pub fn between(&self, from: f64, to: f64) -> Range<usize> {
        let start = self.t.partition_point(|&t| t < from);
        let end = self.t.partition_point(|&t| t < to);
        start..end.max(start)
    }
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
}
