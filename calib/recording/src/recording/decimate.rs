//! Samples far faster than anything that a hand does, as means over blocks of them.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::{Recording, Stream};

/// Rates above this are thinned, and to about which, Hz.
const FASTEST: f64 = 5000.0;
const ENOUGH: f64 = 1000.0;

/// A step so many times the usual one ends a block: nothing is averaged across a gap.
const GAP: f64 = 5.0;

impl Recording {
    /// Returns true if [`Recording::decimated`] would change the recording.
    pub fn is_fast(&self) -> bool {
        let streams = [&self.accelerometer, &self.gyroscope];
        let fast = |stream: &Stream| {
            stream
                .median_step()
                .is_some_and(|step| step * FASTEST < 1.0)
        };
        streams.into_iter().flatten().any(fast)
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
            let Some(step) = stream.median_step().filter(|step| step * FASTEST < 1.0) else {
                continue;
            };
            let rate = step.recip();
            let block = (rate / ENOUGH).round() as usize;
            *stream = means(stream, block, GAP * step);
            self.warnings.push(
                Finding::of(Kind::Averaged)
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
}
