//! Samples that came live, to be found again in the exported file.

use calib::recording::Stream;
use nalgebra::Vector3;

/// Most samples that are remembered.
const MOST: usize = 256;
/// Live values have eight digits.
const DIGITS: f64 = 2e-7;

/// Samples spread over the session, at most [`MOST`], in order.
#[derive(Clone, Debug)]
pub(super) struct Sightings {
    kept: Vec<Vector3<f64>>,
    seen: usize,
    /// Every such sample is remembered.
    stride: usize,
}

impl Default for Sightings {
    fn default() -> Self {
        Self {
            kept: Vec::new(),
            seen: 0,
            stride: 1,
        }
    }
}

impl Sightings {
    /// Remembers a sample, perhaps.
    pub(super) fn see(&mut self, reading: &Vector3<f64>) {
        if self.seen.is_multiple_of(self.stride) {
            self.kept.push(*reading);
        }
        self.seen += 1;
        if self.kept.len() > MOST {
            let mut place = 0;
            self.kept.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            self.stride *= 2;
        }
    }

    /// The share of the samples that are in `stream`, in this order; 1 where there are none.
    pub(super) fn share_in(&self, stream: &Stream) -> f64 {
        if self.kept.is_empty() {
            return 1.0;
        }
        let (mut from, mut found) = (0, 0);
        for seen in &self.kept {
            let is_it = |reading: &Vector3<f64>| {
                let mut pairs = reading.iter().zip(seen.iter());
                pairs.all(|(a, b)| (a - b).abs() <= DIGITS * b.abs().max(1e-6))
            };
            if let Some(at) = stream.values[from..].iter().position(is_it) {
                from += at + 1;
                found += 1;
            }
        }
        f64::from(found) / self.kept.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn session(phase: f64) -> Stream {
        let t: Vec<f64> = (0..5000).map(|k| 0.01 * f64::from(k)).collect();
        let reading =
            |t: &f64| Vector3::new((t + phase).sin(), t.cos(), 9.8 + 0.1 * (3.0 * t).sin());
        let values = t.iter().map(reading).collect();
        Stream { t, values }
    }

    #[test]
    fn eight_digits_of_a_session_are_found_in_it_and_in_no_other() {
        let (own, other) = (session(0.0), session(0.3));
        let mut sightings = Sightings::default();
        assert_eq!(sightings.share_in(&other), 1.0, "nothing was seen");
        for reading in &own.values[700..] {
            let eight_digits = |x: f64| format!("{x:.7e}").parse::<f64>().unwrap();
            sightings.see(&reading.map(eight_digits));
        }
        assert!(sightings.kept.len() > MOST / 2 - 1);
        assert_eq!(sightings.share_in(&own), 1.0);
        assert!(sightings.share_in(&other) < 0.1);
    }
}
