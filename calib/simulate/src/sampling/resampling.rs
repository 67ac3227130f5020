//! A recording at another rate than the sensor's: held or interpolated samples.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{Tick, Ticks};

/// The sensor samples evenly at its own rate, the recording has its stamps and something in between.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub struct Resampled {
    /// Samples per second of the sensor itself.
    pub rate: f64,
    /// Value that is written between two samples.
    #[serde(default)]
    pub by: Between,
}

/// Interpolation between two samples of the sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Between {
    /// The last sample, again.
    #[default]
    Hold,
    /// The straight line between the sample before and the one after.
    Linear,
}

/// A value with the drift in it.
pub(crate) type Reading = [Vector3<f64>; 2];

/// The sensor's own samples around the present.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    by: Between,
    ticks: Ticks,
    before: Option<(f64, Reading)>,
    after: Option<(f64, Reading)>,
}

impl Resampler {
    /// With the sensor's own `ticks`.
    pub fn new(by: Between, ticks: Ticks) -> Self {
        Self {
            by,
            ticks,
            before: None,
            after: None,
        }
    }

    /// Returns the reading that is written at true time `t`, s; `read` makes the sensor's own samples. Times must not decrease.
    pub fn at(&mut self, t: f64, mut read: impl FnMut(&Tick) -> Reading) -> Reading {
        let mut next = || {
            let tick = self.ticks.tick();
            (tick.time, read(&tick))
        };
        let mut after = self.after.take().unwrap_or_else(&mut next);
        let mut before = self.before.take().unwrap_or(after);
        while after.0 <= t {
            before = after;
            after = next();
        }
        (self.before, self.after) = (Some(before), Some(after));
        let length = after.0 - before.0;
        match self.by {
            Between::Linear if length > 0.0 => {
                let share = ((t - before.0) / length).clamp(0.0, 1.0);
                [0, 1].map(|k| before.1[k] * (1.0 - share) + after.1[k] * share)
            }
            _ => before.1,
        }
    }
}

#[cfg(test)]
mod tests {
    use sensor::Sensor;

    use super::*;
    use crate::{Clock, Stamp};

    fn resampled(by: Between) -> Vec<(f64, f64)> {
        let clock = Clock::default();
        let ticks = Ticks::new(&clock, 40.0, Stamp::Centre, 1, Sensor::Gyroscope);
        let mut resampler = Resampler::new(by, ticks);
        let read = |tick: &Tick| [Vector3::repeat(3.0 * tick.time), Vector3::zeros()];
        (0..500)
            .map(|k| f64::from(k) * 0.01)
            .map(|t| (t, resampler.at(t, read)[0].x))
            .collect()
    }

    #[test]
    fn held_values_are_those_of_the_last_sample_of_the_sensor() {
        for (t, value) in resampled(Between::Hold) {
            let last = (t * 40.0 + 1e-9).floor() / 40.0;
            assert!(
                (value - 3.0 * last).abs() < 1e-9
                    || (t * 40.0).fract().min(1.0 - (t * 40.0).fract()) < 1e-6
            );
        }
    }

    #[test]
    fn a_line_comes_back_from_between_its_samples() {
        for (t, value) in resampled(Between::Linear) {
            assert!((value - 3.0 * t).abs() < 1e-12, "{t}: {value}");
        }
    }
}
