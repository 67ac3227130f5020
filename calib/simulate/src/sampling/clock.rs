//! The clock of one sensor: when it samples, and what it says.

use sensor::Sensor;
use serde::{Deserialize, Serialize};

use crate::random::{Purpose, Random};

/// A sensor's own clock.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Clock {
    /// True samples per second; that of the recording where it is not given.
    pub rate: Option<f64>,
    /// True time of the first sample, s.
    pub phase: f64,
    /// Stamps are late by this, s.
    pub offset: f64,
    /// Stamps run fast by this share.
    pub rate_error: f64,
    /// Noise of the stamps (standard deviation), s, of samples taken evenly; stamps stay a tenth of a step
    /// apart.
    pub jitter: f64,
    /// Unevenness of the sampling itself (standard deviation), s, cut at 0.4 of a step; the stamps are
    /// right.
    pub sampling_jitter: f64,
    /// Share of the samples that are missing, one at a time at random; the stamps show it.
    pub lost: f64,
    /// Stamps are rounded to multiples of this, s; 0 for none.
    pub resolution: f64,
}

/// From a moment on, stamps run fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ClockChange {
    /// True time, s.
    pub start: f64,
    /// By this share.
    pub rate_error: f64,
}

/// Position of the time stamp in a sample's window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stamp {
    /// In the middle.
    #[default]
    Centre,
    /// At the end.
    End,
}

/// One sample's window and stamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tick {
    /// True begin of the window, s.
    pub from: f64,
    /// True end of the window, s.
    pub to: f64,
    /// True time at the position of the stamp, s.
    pub time: f64,
    /// Time by the clock, s.
    pub stamp: f64,
}

/// Least distance of noisy stamps, in steps: who stamps the samples does so one after the other.
const CLOSEST: f64 = 0.1;

/// The samples of one clock, one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Ticks {
    clock: Clock,
    rate: f64,
    place: Stamp,
    count: u64,
    /// Samples that the clock has not counted.
    closed_up: u64,
    /// Stamp of the last sample, s.
    last: f64,
    changes: Vec<ClockChange>,
    random: Random,
    sampling: Random,
}

impl Ticks {
    pub fn new(clock: &Clock, rate: f64, place: Stamp, seed: u64, sensor: Sensor) -> Self {
        Self {
            rate: clock.rate.unwrap_or(rate),
            clock: clock.clone(),
            place,
            count: 0,
            closed_up: 0,
            last: f64::NEG_INFINITY,
            changes: Vec::new(),
            random: Random::new(seed, Purpose::Clock(sensor)),
            sampling: Random::new(seed, Purpose::Sampling(sensor)),
        }
    }

    /// With a clock that changes.
    #[must_use]
    pub fn with_changes(mut self, changes: Vec<ClockChange>) -> Self {
        self.changes = changes;
        self
    }

    /// The next sample; there is always one more.
    pub fn tick(&mut self) -> Tick {
        let step = self.rate.recip();
        let mut time = self.clock.phase + self.count as f64 / self.rate;
        self.count += 1;
        if self.clock.sampling_jitter > 0.0 {
            let limit = 0.4 * step;
            let late = self.clock.sampling_jitter * self.sampling.normal();
            time += late.clamp(-limit, limit);
        }
        let to = match self.place {
            Stamp::Centre => time + 0.5 * step,
            Stamp::End => time,
        };
        Tick {
            from: to - step,
            to,
            time,
            stamp: self.stamp(time, step),
        }
    }

    /// Leaves the last sample uncounted: the stamps after it are a step earlier.
    pub fn close_up(&mut self) {
        self.closed_up += 1;
    }

    fn stamp(&mut self, time: f64, step: f64) -> f64 {
        let clock = &self.clock;
        let counted = time - self.closed_up as f64 * step;
        let mut stamp = counted * (1.0 + clock.rate_error) + clock.offset;
        for change in &self.changes {
            stamp += (counted - change.start).max(0.0) * change.rate_error;
        }
        if clock.jitter > 0.0 {
            stamp += clock.jitter * self.random.normal();
            stamp = stamp.max(self.last + CLOSEST * step);
            self.last = stamp;
        }
        if clock.resolution > 0.0 {
            stamp = (stamp / clock.resolution).round() * clock.resolution;
        }
        stamp
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(clock: Clock, place: Stamp) -> Vec<Tick> {
        let mut ticks = Ticks::new(&clock, 100.0, place, 5, Sensor::Gyroscope);
        (0..1000).map(|_| ticks.tick()).collect()
    }

    #[test]
    fn windows_tile_time_and_the_stamp_lies_where_it_should() {
        for (place, before) in [(Stamp::Centre, 0.005), (Stamp::End, 0.01)] {
            let all = ticks(Clock::default(), place);
            for pair in all.windows(2) {
                assert!((pair[0].to - pair[1].from).abs() < 1e-14);
                assert!((pair[0].stamp - pair[0].from - before).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn stamps_increase_under_jitter_of_any_size() {
        let clock = Clock {
            jitter: 1.0,
            resolution: 1e-4,
            ..Clock::default()
        };
        assert!(
            ticks(clock, Stamp::Centre)
                .windows(2)
                .all(|w| w[0].stamp < w[1].stamp)
        );
    }

    /// Root mean square of what is noise about an even clock of 100 per second.
    fn scatter(of: impl Iterator<Item = f64>) -> f64 {
        let squares: Vec<f64> = of
            .enumerate()
            .map(|(k, t)| (t - k as f64 / 100.0).powi(2))
            .collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    #[test]
    fn sampling_jitter_moves_the_sample_and_its_stamp_together() {
        let clock = Clock {
            sampling_jitter: 5e-4,
            ..Clock::default()
        };
        let all = ticks(clock, Stamp::Centre);
        assert!(all.iter().all(|tick| tick.stamp == tick.time));
        assert!(all.iter().all(|t| (t.to - t.from - 0.01).abs() < 1e-12));
        // 1000 draws: a standard error of 2.2 %; four of them.
        let ratio = scatter(all.iter().map(|t| t.time)) / 5e-4;
        assert!((ratio - 1.0).abs() < 0.09, "{ratio}");
    }

    #[test]
    fn stamp_noise_leaves_the_sampling_even() {
        let clock = Clock {
            jitter: 1.5e-3,
            ..Clock::default()
        };
        let all = ticks(clock, Stamp::Centre);
        assert!(scatter(all.iter().map(|t| t.time)) < 1e-12);
        let ratio = scatter(all.iter().map(|t| t.stamp)) / 1.5e-3;
        assert!((ratio - 1.0).abs() < 0.09, "{ratio}");
    }

    #[test]
    fn a_clock_that_changes_runs_fast_from_then_on() {
        let change = ClockChange {
            start: 5.0,
            rate_error: 0.02,
        };
        let clock = Clock::default();
        let ticks = Ticks::new(&clock, 100.0, Stamp::Centre, 5, Sensor::Gyroscope);
        let mut ticks = ticks.with_changes(vec![change]);
        let stamps: Vec<f64> = (0..1000).map(|_| ticks.tick().stamp).collect();
        assert!((stamps[499] - 4.99).abs() < 1e-12);
        assert!((stamps[900] - (9.0 + 0.02 * 4.0)).abs() < 1e-12);
    }

    #[test]
    fn a_late_and_fast_clock_says_so_in_every_stamp() {
        let clock = Clock {
            offset: 0.02,
            rate_error: 1e-3,
            ..Clock::default()
        };
        let last = ticks(clock, Stamp::Centre)[999];
        assert!((last.stamp - (9.99 * 1.001 + 0.02)).abs() < 1e-12);
        assert!((last.time - 9.99).abs() < 1e-12);
    }
}
