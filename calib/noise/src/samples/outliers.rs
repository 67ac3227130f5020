//! Single samples far from their neighbours, which no noise makes: they are left out before anything is averaged.

use std::collections::VecDeque;

use nalgebra::Vector3;
use recording::readings::lone_sample::{self, AROUND, Resolution};

findings::tuning! {
    /// Only a sample that leaves its neighbours by so many times the usual change is looked at closely.
    LOOK: f64 = 4.0;
    /// The usual change is that of so many samples.
    MEMORY: f64 = 64.0;

    /// Times that are kept.
    KEPT: usize = 4;
}

/// Samples that were left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outliers {
    /// Number of samples.
    pub count: usize,
    /// The first of them, s.
    pub times: Vec<f64>,
    /// On which axes.
    pub axes: [bool; 3],
    /// The largest distance from a neighbour, in the unit of the samples.
    pub largest: f64,
}

impl Outliers {
    fn add(&mut self, t: f64, sizes: &[f64; 3]) {
        self.count += 1;
        if self.times.len() < KEPT.get() {
            self.times.push(t);
        }
        for (axis, size) in self.axes.iter_mut().zip(sizes) {
            *axis |= *size > 0.0;
            self.largest = self.largest.max(*size);
        }
    }
}

/// Puts the reading before in the place of every outlier, as samples pass: fifty before and after each are kept.
///
/// The reading before is one that the sensor can give; the mean of the neighbours may lie between two of its steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct WithoutOutliers {
    window: VecDeque<(f64, Vector3<f64>)>,
    /// Place in the window of the next sample to be judged.
    next: usize,
    usual: [Usual; 3],
    found: Outliers,
}

/// The usual change and scatter of an axis.
#[derive(Clone, Copy, Debug)]
struct Usual {
    /// Mean change from sample to sample; none before the first is judged.
    change: Option<f64>,
    /// Smallest change and smallest reading.
    resolution: Resolution,
}

impl Default for Usual {
    fn default() -> Self {
        Self {
            change: None,
            resolution: Resolution {
                step: f64::INFINITY,
                beside_zero: f64::INFINITY,
            },
        }
    }
}

impl WithoutOutliers {
    /// The next sample; those that are judged go to `out`.
    pub fn push(&mut self, t: f64, value: Vector3<f64>, out: &mut impl FnMut(f64, Vector3<f64>)) {
        let last = self.window.back().map(|(_, last)| *last);
        for (axis, usual) in self.usual.iter_mut().enumerate() {
            let least = |known: f64, size: f64| if size > 0.0 { known.min(size) } else { known };
            let known = &mut usual.resolution;
            known.beside_zero = least(known.beside_zero, value[axis].abs());
            if let Some(last) = last {
                known.step = least(known.step, (value[axis] - last[axis]).abs());
            }
        }
        self.window.push_back((t, value));
        if self.window.len() > self.next + AROUND.get() {
            self.judge(out);
        }
    }

    /// Hands on what is left.
    pub fn finish(&mut self, out: &mut impl FnMut(f64, Vector3<f64>)) {
        while self.next < self.window.len() {
            self.judge(out);
        }
    }

    /// The outliers that were found.
    pub fn found(&self) -> &Outliers {
        &self.found
    }

    fn judge(&mut self, out: &mut impl FnMut(f64, Vector3<f64>)) {
        let k = self.next;
        let sizes = [0, 1, 2].map(|axis| self.size(axis, k));
        let Some(&(t, mut value)) = self.window.get(k) else {
            return;
        };
        if sizes.iter().any(|size| *size > 0.0) {
            self.found.add(t, &sizes);
        }
        if let Some(&(_, before)) = k.checked_sub(1).and_then(|k| self.window.get(k)) {
            for axis in 0..3 {
                if sizes[axis] > 0.0 {
                    value[axis] = before[axis];
                }
                let change = (value[axis] - before[axis]).abs();
                if let Some(usual) = &mut self.usual[axis].change {
                    *usual += (change - *usual) / MEMORY.get();
                }
            }
            self.window[k].1 = value;
        }
        out(t, value);
        if self.next == AROUND.get() {
            self.window.pop_front();
        } else {
            self.next += 1;
        }
    }

    /// How far a sample is from the nearer neighbour, if it is an outlier on an axis; else zero.
    fn size(&mut self, axis: usize, k: usize) -> f64 {
        let usual = match self.usual[axis].change {
            Some(change) => change,
            None => *self.usual[axis]
                .change
                .insert(mean_change(&self.window, axis)),
        };
        let of = |k: usize| self.window.get(k).map(|(_, value)| value[axis]);
        let (Some(before), Some(at), Some(after)) =
            (k.checked_sub(1).and_then(of), of(k), of(k + 1))
        else {
            return 0.0;
        };
        let size = lone_sample::size([before, at, after]);
        match size > LOOK.get() * usual && self.stands_out(axis, k, at, size) {
            true => size,
            false => 0.0,
        }
    }

    /// Returns true if a sample stands out from those around it.
    fn stands_out(&self, axis: usize, k: usize, at: f64, size: f64) -> bool {
        let near = k.saturating_sub(1)..k + 2;
        let others = self.window.iter().enumerate();
        let others = others.filter(|(place, _)| !near.contains(place));
        let around: Vec<f64> = others.map(|(_, (_, value))| value[axis]).collect();
        lone_sample::stands_out(at, size, &around, &self.usual[axis].resolution)
    }
}

/// The mean change from sample to sample.
fn mean_change(window: &VecDeque<(f64, Vector3<f64>)>, axis: usize) -> f64 {
    let pairs = window.iter().zip(window.iter().skip(1));
    let sum: f64 = pairs
        .map(|((_, a), (_, b))| (b[axis] - a[axis]).abs())
        .sum();
    sum / window.len().saturating_sub(1).max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number between −1 and 1 for every place, as if by chance.
    fn by_chance(k: usize) -> f64 {
        let z = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn passed(value: impl Fn(usize) -> f64) -> (Vec<f64>, Outliers) {
        let mut without = WithoutOutliers::default();
        let mut all = Vec::new();
        let mut keep = |_: f64, value: Vector3<f64>| all.push(value.x);
        for k in 0..5000 {
            without.push(k as f64 * 0.02, Vector3::new(value(k), 0.0, 9.8), &mut keep);
        }
        without.finish(&mut keep);
        (all, without.found().clone())
    }

    #[test]
    fn outliers_are_replaced_at_their_places_and_the_others_pass_as_they_are() {
        let places = [3, 700, 730, 4990];
        let (all, found) = passed(|k| by_chance(k) + if places.contains(&k) { 40.0 } else { 0.0 });
        assert_eq!((found.count, found.axes), (4, [true, false, false]));
        assert!((found.times[1] - 14.0).abs() < 1e-9 && (found.largest - 40.0).abs() < 2.0);
        for (k, value) in all.iter().enumerate() {
            let expected = if places.contains(&k) { k - 1 } else { k };
            assert_eq!(*value, by_chance(expected), "{k}");
        }
        assert_eq!(all.len(), 5000);
    }

    #[test]
    fn noise_knocks_of_two_samples_turns_steps_and_flickers_are_no_outliers() {
        let knock = |k: usize| by_chance(k) + if k / 2 == 1000 { 40.0 } else { 0.0 };
        let turn = |k: usize| {
            by_chance(k)
                + if (1000..1500).contains(&k) {
                    40.0 * (0.3 * k as f64).sin()
                } else {
                    0.0
                }
        };
        let step = |k: usize| by_chance(k) + if k > 3000 { 40.0 } else { 0.0 };
        let flicker = |k: usize| if by_chance(k) > 0.99 { 0.05 } else { 0.0 };
        let dead_zone = |k: usize| {
            if by_chance(k) > 0.98 {
                2.0 + by_chance(k + 9000)
            } else {
                0.0
            }
        };
        let values: [&dyn Fn(usize) -> f64; 6] =
            [&by_chance, &knock, &turn, &step, &flicker, &dead_zone];
        for (place, value) in values.into_iter().enumerate() {
            let (all, found) = passed(value);
            assert_eq!(found, Outliers::default(), "{place}");
            assert!(
                all.iter().enumerate().all(|(k, v)| *v == value(k)),
                "{place}"
            );
        }
    }
}
