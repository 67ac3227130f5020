//! Single readings that nothing else in the recording shares.
//!
//! A knock rings on for some samples, on several axes, and both sensors feel it; a motion lasts. A reading that a transfer spoilt is
//! off on one axis for one sample.

use nalgebra::Vector3;
use sensor::Sensor;

use super::resolution::{Spike, resolution, usual_reach};
use crate::averages::{NORMAL_OVER_MEDIAN, median};
use crate::readings::lone_sample::{AROUND, Resolution};
use crate::recording::Stream;

/// Samples on each side in which a knock would ring on, or a motion go on: the size of a window.
const NEAR: usize = 10;
/// The same with the samples that their departures are measured from.
const SIDE: usize = NEAR + 2;

findings::tuning! {
    /// Samples on each side that show whether the device rests.
    RESTING: usize = 20;

    /// A spike leaves the curve through its neighbours by so many standard deviations of the noise while the device rests ...
    AT_REST: f64 = 20.0;
    /// ... or turns. The shocks of a phone that is laid down or pushed reach 47.
    IN_TURNS: f64 = 60.0;
    /// It is so many times larger than what the samples near it do ...
    OVER_NEAR: f64 = 3.0;
    /// ... and its neighbours differ by less than this share of it.
    NEIGHBOURS: f64 = 0.5;

    /// Every other axis stays within so many standard deviations of its noise ...
    SEEN: f64 = 6.0;
    /// ... or within so many times what it does near by.
    USUAL: f64 = 1.5;

    /// At rest a spike is so many times the scatter of the level around it ...
    OVER_SCATTER: f64 = 8.0;
    /// ... and so many times what that level moves ...
    OVER_LEVEL: f64 = 5.0;
    /// ... and the rates move by less than this share of what they usually reach ...
    TURNING: f64 = 0.2;
    /// ... or by so many standard deviations.
    TURNING_NOISE: f64 = 8.0;

    /// Half as large ones may be so many more than the spikes: of heavy tails they are far more.
    MORE_SMALL: usize = 2;
}

/// Lists the readings of a sensor that neither its other axes, nor the samples next to them, nor the other sensor share.
pub(super) fn alone(sensor: Sensor, own: &Stream, other: &Stream) -> Vec<Spike> {
    let rates = match sensor {
        Sensor::Gyroscope => own,
        Sensor::Accelerometer | Sensor::Magnetometer => other,
    };
    let search = Search {
        sensor,
        own,
        other,
        rates,
        reach: usual_reach(&rates.values),
    };
    let all: Vec<(Spike, f64)> = (0..3).flat_map(|axis| search.of_axis(axis)).collect();
    let small = all.iter().filter(|(_, share)| *share < 1.0).count();
    let spikes = all.into_iter().filter(|(_, share)| *share >= 1.0);
    let spikes: Vec<Spike> = spikes.map(|(spike, _)| spike).collect();
    match small <= spikes.len() + MORE_SMALL.get() {
        true => spikes,
        false => Vec::new(),
    }
}

/// Both sensors, while spikes of one are looked for.
struct Search<'a> {
    sensor: Sensor,
    own: &'a Stream,
    other: &'a Stream,
    /// The gyroscope's.
    rates: &'a Stream,
    /// The size that its readings usually reach.
    reach: f64,
}

impl Search<'_> {
    /// Lists what stands alone on an axis, with its size over the least of a spike, from one half on.
    fn of_axis(&self, axis: usize) -> Vec<(Spike, f64)> {
        let values = &self.own.values;
        let resolution = resolution(self.sensor, values, axis);
        let far = far(values, axis, resolution.step);
        far.into_iter()
            .filter_map(|at| self.judged(axis, at, &resolution))
            .collect()
    }

    fn judged(&self, axis: usize, at: usize, resolution: &Resolution) -> Option<(Spike, f64)> {
        let window = Window::of(&self.own.values, axis, at)?;
        let size = window.size().filter(|size| window.returns(*size))?;
        let departure = window.departure(SIDE).abs();
        let noise =
            noise(&self.own.values, axis, at).max(least(&self.own.values, axis, at, resolution));
        let over_noise = departure / noise;
        let at_rest = || self.rests(axis, at, size);
        let share = match self.sensor {
            Sensor::Gyroscope if over_noise > IN_TURNS.get() => over_noise / IN_TURNS.get(),
            _ if over_noise > 0.5 * AT_REST.get() && at_rest() => over_noise / AT_REST.get(),
            _ => return None,
        };
        let stands_out = departure > OVER_NEAR.get() * window.bridged().largest(1..=NEAR);
        (stands_out && !self.is_seen(axis, at)).then_some((Spike { axis, at, size }, share))
    }

    /// Returns true if another axis, or the other sensor, does something at the same time.
    fn is_seen(&self, axis: usize, at: usize) -> bool {
        let values = &self.own.values;
        // All axes of a row that was lost read zero.
        let own = values[at] != Vector3::zeros()
            && (0..3).any(|a| a != axis && does_something(values, a, at));
        own || self
            .beside(self.other, at)
            .is_none_or(|at| (0..3).any(|a| does_something(&self.other.values, a, at)))
    }

    /// The sample of a stream nearest to one of the own.
    fn beside(&self, stream: &Stream, at: usize) -> Option<usize> {
        let time = self.own.t[at];
        let next = stream.t.partition_point(|t| *t < time);
        let near = [next.checked_sub(1)?, next];
        let off = |k: usize| stream.t.get(k).map(|t| (t - time).abs());
        let nearest = near.into_iter().filter_map(|k| Some((off(k)?, k)));
        let (off, k) = nearest.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (off <= stream.median_step()?).then_some(k)
    }

    /// Returns true if the level of the axis stays where it is around a spike of this size, and the device does not turn.
    fn rests(&self, axis: usize, at: usize, size: f64) -> bool {
        let (scatter, moved) = around(&self.own.values, axis, at);
        let is_level = size > OVER_SCATTER.get() * scatter && size > OVER_LEVEL.get() * moved;
        let turns = |at: usize| {
            (0..3).any(|axis| {
                let (_, moved) = around(&self.rates.values, axis, at);
                moved > TURNING.get() * self.reach
                    && moved > TURNING_NOISE.get() * noise(&self.rates.values, axis, at)
            })
        };
        is_level && self.beside(self.rates, at).is_some_and(|at| !turns(at))
    }
}

/// Scatter of the samples around one, as a standard deviation, and the largest distance from their median.
fn around(values: &[Vector3<f64>], axis: usize, at: usize) -> (f64, f64) {
    let before = &values[at.saturating_sub(RESTING.get())..at.saturating_sub(1)];
    let after = &values[(at + 2).min(values.len())..(at + RESTING.get() + 1).min(values.len())];
    let level: Vec<f64> = before.iter().chain(after).map(|v| v[axis]).collect();
    let middle = median(level.iter().copied()).unwrap_or(0.0);
    let off = || level.iter().map(|v| (v - middle).abs());
    let scatter = NORMAL_OVER_MEDIAN * median(off()).unwrap_or(0.0);
    (scatter, off().fold(0.0, f64::max))
}

/// Returns true if an axis does more next to a sample than its noise and than it does near by.
fn does_something(values: &[Vector3<f64>], axis: usize, at: usize) -> bool {
    let Some(window) = Window::of(values, axis, at) else {
        return true;
    };
    // A row that was lost reads zero in both sensors.
    let window = match values[at] == Vector3::zeros() {
        true => window.bridged(),
        false => window,
    };
    let done = window.largest(0..=2);
    let step = || window.least_step();
    done > USUAL.get() * window.largest(3..=NEAR)
        && done > SEEN.get() * noise(values, axis, at).max(step())
}

/// The least that a reading is told from: the resolution, and half the width of a dead zone beside readings of zero.
fn least(values: &[Vector3<f64>], axis: usize, at: usize, resolution: &Resolution) -> f64 {
    let near = &values[at.saturating_sub(AROUND.get())..(at + AROUND.get() + 1).min(values.len())];
    match near.iter().any(|v| v[axis] == 0.0) && values[at] != Vector3::zeros() {
        true => resolution.step.max(resolution.beside_zero),
        false => resolution.step.max(f64::MIN_POSITIVE),
    }
}

/// Departure of a reading from the cubic through two neighbours on each side.
fn departure(at: impl Fn(usize) -> f64, k: usize) -> f64 {
    at(k) - (4.0 * (at(k - 1) + at(k + 1)) - at(k - 2) - at(k + 2)) / 6.0
}

/// Standard deviation of the departures around a sample.
fn noise(values: &[Vector3<f64>], axis: usize, at: usize) -> f64 {
    let last = values.len().saturating_sub(2);
    let near = at.saturating_sub(AROUND.get()).max(2)..(at + AROUND.get() + 1).min(last);
    let sizes = near.map(|k| departure(|i| values[i][axis], k).abs());
    NORMAL_OVER_MEDIAN * median(sizes).unwrap_or(0.0)
}

/// Places whose departures are large against those of their block, or of both beside it.
fn far(values: &[Vector3<f64>], axis: usize, step: f64) -> Vec<usize> {
    if values.len() < 2 * AROUND.get() {
        return Vec::new();
    }
    let all = 2..values.len() - 2;
    let sizes: Vec<f64> = all
        .map(|k| departure(|i| values[i][axis], k).abs())
        .collect();
    let blocks = sizes.chunks(AROUND.get());
    let usual: Vec<f64> = blocks
        .map(|block| NORMAL_OVER_MEDIAN * median(block.iter().copied()).unwrap_or(0.0))
        .collect();
    let is_far = |k: usize| {
        let block = k / AROUND.get();
        let near = &usual[block.saturating_sub(1)..(block + 2).min(usual.len())];
        let least = near.iter().copied().fold(f64::INFINITY, f64::min);
        sizes[k] > 0.5 * AT_REST.get() * least.max(step)
    };
    let found = (0..sizes.len()).filter(|k| is_far(*k));
    found.map(|k| k + 2).collect()
}

/// Readings of an axis around a sample.
#[derive(Clone, Copy)]
struct Window([f64; 2 * SIDE + 1]);

impl Window {
    fn of(values: &[Vector3<f64>], axis: usize, at: usize) -> Option<Self> {
        let part = values.get(at.checked_sub(SIDE)?..at + SIDE + 1)?;
        Some(Self(std::array::from_fn(|k| part[k][axis])))
    }

    fn departure(&self, k: usize) -> f64 {
        departure(|i| self.0[i], k)
    }

    /// The same with the sample in the middle on the curve through its neighbours.
    fn bridged(mut self) -> Self {
        self.0[SIDE] -= self.departure(SIDE);
        self
    }

    /// The largest departure at these distances from the middle.
    fn largest(&self, distances: std::ops::RangeInclusive<usize>) -> f64 {
        let both = distances.flat_map(|d| [SIDE - d, SIDE + d]);
        both.map(|k| self.departure(k).abs()).fold(0.0, f64::max)
    }

    /// Distance from the nearer neighbour, where the middle lies above or below both.
    fn size(&self) -> Option<f64> {
        let [before, at, after] = [SIDE - 1, SIDE, SIDE + 1].map(|k| self.0[k]);
        let (left, right) = (at - before, at - after);
        (left * right > 0.0).then(|| left.abs().min(right.abs()))
    }

    /// Returns true if the reading after it is where the one before it was.
    fn returns(&self, size: f64) -> bool {
        (self.0[SIDE + 1] - self.0[SIDE - 1]).abs() < NEIGHBOURS.get() * size
    }

    /// The smallest step between its readings that is not zero.
    fn least_step(&self) -> f64 {
        let steps = self.0.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let least = steps.filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise_of(k: usize, m: usize) -> f64 {
        let wave = (12.9898 * k as f64 + 78.233 * m as f64).sin() * 43_758.545;
        2.0 * (wave - wave.floor()) - 1.0
    }

    fn stream(size: f64, turning: bool) -> Stream {
        let value = |k: usize| {
            let turn = match turning && (1000..1500).contains(&k) {
                true => (std::f64::consts::PI * (k - 1000) as f64 / 500.0)
                    .sin()
                    .powi(2),
                false => 0.0,
            };
            Vector3::new(3.0, 5.0, 7.0).map(|m| {
                let wander = size * noise_of(k, m as usize);
                wander + turn * m / 5.0
            })
        };
        Stream {
            t: (0..4000).map(|k| 0.01 * f64::from(k)).collect(),
            values: (0..4000).map(value).collect(),
        }
    }

    fn found(own: &Stream, other: &Stream) -> Vec<(usize, usize)> {
        let spikes = alone(Sensor::Gyroscope, own, other);
        spikes.iter().map(|s| (s.axis, s.at)).collect()
    }

    #[test]
    fn one_reading_at_rest_and_one_in_a_turn_stand_alone() {
        let (mut own, other) = (stream(2e-3, true), stream(0.02, true));
        assert_eq!(found(&own, &other), []);
        own.values[2500].x += 0.5;
        own.values[1200].z -= 0.5;
        assert_eq!(found(&own, &other), [(0, 2500), (2, 1200)]);
    }

    #[test]
    fn a_knock_that_the_other_sensor_feels_is_no_spike() {
        let (mut own, mut other) = (stream(2e-3, true), stream(0.02, true));
        own.values[2500].x += 0.5;
        other.values[2501].y += 1.0;
        assert_eq!(found(&own, &other), []);
    }

    #[test]
    fn a_jerk_that_goes_on_or_is_on_two_axes_is_no_spike() {
        let (mut own, other) = (stream(2e-3, true), stream(0.02, true));
        own.values[2500].x += 0.5;
        own.values[2501].x += 0.3;
        own.values[3000].y += 0.5;
        own.values[3000].z += 0.5;
        assert_eq!(found(&own, &other), []);
    }

    #[test]
    fn a_row_that_reads_zero_in_both_sensors_stands_alone() {
        let (mut own, mut other) = (stream(2e-3, true), stream(0.02, true));
        other.values.iter_mut().for_each(|v| v.z += 9.8);
        own.values[1200] = Vector3::zeros();
        other.values[1200] = Vector3::zeros();
        assert_eq!(found(&own, &other), [(0, 1200), (1, 1200), (2, 1200)]);
    }

    #[test]
    fn heavy_tails_hold_no_spikes() {
        let (mut own, other) = (stream(2e-3, false), stream(0.02, false));
        for k in 0..20 {
            own.values[300 + 150 * k].x += 2e-3 * (8.5 + 0.4 * k as f64);
        }
        assert_eq!(found(&own, &other), []);
    }
}
