//! Samples far faster than anything that a hand does, as means over blocks of them.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::{Recording, Stream};
use crate::clock::even::bursts;

findings::tuning! {
    /// Rates above this are thinned, Hz.
    FASTEST: f64 = 5000.0;
    /// To about this rate, Hz.
    ENOUGH: f64 = 1000.0;

    /// A step so many times the usual one ends a block: nothing is averaged across a gap.
    GAP: f64 = 5.0;
}

impl Recording {
    /// Returns true if [`Recording::decimated`] would change the recording.
    pub fn is_fast(&self) -> bool {
        let streams = [&self.accelerometer, &self.gyroscope];
        streams
            .into_iter()
            .flatten()
            .any(|s| fast_step(s).is_some())
    }

    /// The recording with sensors faster than 5 kHz read as means over blocks of samples, at about 1 kHz, and a warning
    /// that says so. A mean over `m` samples is a filter `sin(π f m/r) / (m sin(π f/r))` at the rate `r`: it takes 0.02 % off
    /// a motion of 10 Hz, and nothing off a turn as a whole.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::Recording;
    /// use stillpoint_recording::Stream;
    /// use nalgebra::Vector3;
    ///
    /// let t: Vec<f64> = (0..60_000).map(|k| f64::from(k) / 30_000.0).collect();
    /// let values = vec![Vector3::new(0.0, 0.0, 9.8); t.len()];
    /// let fast = Recording { accelerometer: Some(Stream { t, values }), ..Recording::default() };
    /// let slow = fast.decimated();
    /// assert_eq!(slow.accelerometer.unwrap().len(), 2000);
    /// assert_eq!(slow.warnings[0].value("rate").map(f64::round), Some(30_000.0));
    /// ```
    #[must_use]
    pub fn decimated(mut self) -> Self {
        let sensors = [
            (Sensor::Accelerometer, &mut self.accelerometer),
            (Sensor::Gyroscope, &mut self.gyroscope),
        ];
        for (sensor, stream) in sensors {
            let Some(stream) = stream else { continue };
            let Some(step) = fast_step(stream) else {
                continue;
            };
            let rate = step.recip();
            let block = (rate / ENOUGH.get()).round() as usize;
            // The wait for a burst is no gap.
            if let Some(bursts) = bursts(&stream.t) {
                stream.t = bursts.even;
            }
            *stream = means(stream, block, GAP.get() * step);
            self.warnings.push(
                Finding::of(Kind::AVERAGED)
                    .in_recording(&self.name)
                    .of_sensor(sensor)
                    .number("rate", rate, "Hz")
                    .count("block", block)
                    .number("then", rate / block as f64, "Hz"),
            );
        }
        self
    }
}

/// The usual step of a sensor that is read as means, s.
fn fast_step(stream: &Stream) -> Option<f64> {
    stream
        .usual_step()
        .filter(|step| step * FASTEST.get() < 1.0)
}

/// Means over `block` samples each; a step longer than `gap` begins a new one, and what is left of the old is dropped.
fn means(stream: &Stream, block: usize, gap: f64) -> Stream {
    let mut out = Stream::default();
    let mut from = 0;
    for k in 0..stream.len() {
        if k > from && stream.t[k] - stream.t[k - 1] > gap {
            from = k;
        }
        if k + 1 - from == block {
            let share = (block as f64).recip();
            let t = &stream.t[from..=k];
            // About the first, so that large stamps lose no digits.
            let later: f64 = t.iter().map(|t| t - stream.t[from]).sum();
            out.t.push(stream.t[from] + later * share);
            let sum: Vector3<f64> = stream.values[from..=k].iter().sum();
            out.values.push(sum * share);
            from = k + 1;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_end_at_gaps() {
        let mut t: Vec<f64> = (0..10).map(f64::from).collect();
        t[7..].iter_mut().for_each(|t| *t += 100.0);
        let values = t.iter().map(|&t| Vector3::repeat(t)).collect();
        let found = means(&Stream { t, values }, 3, 5.0);
        assert_eq!(found.t, [1.0, 4.0, 108.0]);
        assert_eq!(found.values[2], Vector3::repeat(108.0));
    }

    /// A gyroscope of `rate` whose readings are the seconds, and whose samples arrive `size` at a time, `within` s apart.
    fn arrived(rate: f64, size: usize, within: f64) -> Recording {
        let true_time = |k: usize| k as f64 / rate;
        let stamp = |k: usize| true_time(k / size * size + size - 1) + within * (k % size) as f64;
        let stream = Stream {
            t: (0..20_000).map(stamp).collect(),
            values: (0..20_000).map(|k| Vector3::repeat(true_time(k))).collect(),
        };
        Recording {
            gyroscope: Some(stream),
            ..Recording::default()
        }
    }

    #[test]
    fn slow_samples_in_bursts_are_not_fast() {
        for size in [2, 4, 8] {
            for within in [1e-5, 1e-4, 1.9e-4] {
                let slow = arrived(100.0, size, within);
                assert!(!slow.is_fast(), "{size} samples {within} s apart");
                assert_eq!(slow.clone().decimated().gyroscope, slow.gyroscope);
            }
        }
    }

    #[test]
    fn fast_samples_in_bursts_are_means_at_even_times() {
        let found = arrived(8000.0, 16, 1e-6).decimated();
        let rate = found.warnings[0].value("rate").unwrap();
        assert!((rate - 8000.0).abs() < 1.0, "{rate}");
        let stream = found.gyroscope.unwrap();
        assert_eq!(stream.len(), 2500);
        let late = |k: usize| stream.t[k] - stream.values[k].x;
        // The last sample of a burst is late by the time that the burst is read in.
        assert!((late(1200) - 15e-6).abs() < 1e-6, "{}", late(1200));
        assert!((late(700) - late(1800)).abs() < 2e-4);
    }
}
