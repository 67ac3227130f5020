//! The usual step of stamps: their median step, or the time over the samples where they come in bursts.

use super::bursts::step_of_bursts;
use crate::recording::stream::{Stream, median_step};

/// The usual time between samples, in the unit of the stamps; `None` with fewer than two.
///
/// Most steps of stamps in bursts are within a burst, and say how fast the host wrote them down. What is decided by a rate
/// (the unit of the stamps, means of fast readings) is decided by this step.
pub(crate) fn usual_step(t: &[f64]) -> Option<f64> {
    step_of_bursts(t).or_else(|| median_step(t))
}

impl Stream {
    /// Usual time between samples, s: the median step, or the time over the samples where they come in bursts; `None` with
    /// fewer than two.
    pub fn usual_step(&self) -> Option<f64> {
        usual_step(&self.t)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal, Uniform};

    use super::*;

    const COUNT: usize = 6000;

    fn random(seed: u64) -> rand_chacha::ChaCha8Rng {
        rand_chacha::ChaCha8Rng::seed_from_u64(seed)
    }

    /// Stamps of samples of 100 Hz that a host reads `size` at a time, `within` s apart, up to `late` s after the last.
    fn arrived(size: usize, within: f64, late: f64) -> Vec<f64> {
        let mut random = random(7);
        let delay = Uniform::new_inclusive(0.0, late).unwrap();
        let delays: Vec<f64> = (0..=COUNT / size)
            .map(|_| delay.sample(&mut random))
            .collect();
        let stamp = |k: usize| {
            let last = (k / size * size + size - 1) as f64;
            1e-2 * last + within * (k % size) as f64 + delays[k / size]
        };
        (0..COUNT).map(stamp).collect()
    }

    #[test]
    fn the_usual_step_of_bursts_is_the_time_over_the_samples() {
        for size in [2, 4, 8] {
            for within in [1e-5, 1e-4, 2e-4, 1e-3] {
                for late in [0.0, 5e-4 * size as f64] {
                    let stamps = arrived(size, within, late);
                    let step = usual_step(&stamps).unwrap();
                    let place = format!("{size} samples {within} s apart, late by {late} s");
                    // Two ends that are late by chance, over a minute.
                    assert!((step / 1e-2 - 1.0).abs() < 2e-4, "{place}: {step}");
                    let found = super::super::bursts(&stamps).unwrap();
                    assert!((found.size - size as f64).abs() < 0.1, "{place}");
                    assert!((found.step / step - 1.0).abs() < 2e-4, "{place}");
                }
            }
        }
    }

    #[test]
    fn the_usual_step_of_bursts_is_in_the_unit_of_the_stamps() {
        for per_second in [1e3, 1e6, 1e9] {
            let stamps = arrived(8, 1e-3, 4e-3);
            let stamps: Vec<f64> = stamps.iter().map(|t| (t * per_second).round()).collect();
            let step = usual_step(&stamps).unwrap() / per_second;
            assert!((step / 1e-2 - 1.0).abs() < 2e-4, "{per_second}: {step}");
        }
    }

    #[test]
    fn the_usual_step_of_a_host_clock_that_jitters_is_the_median_step() {
        let mut random = random(3);
        for scatter in [2e-4, 1e-3, 3e-3] {
            let mut stamps: Vec<f64> = (0..COUNT)
                .map(|k| {
                    let late: f64 = StandardNormal.sample(&mut random);
                    1e-2 * k as f64 + scatter * late
                })
                .collect();
            stamps.sort_by(f64::total_cmp);
            assert_eq!(usual_step(&stamps), median_step(&stamps), "{scatter}");
        }
    }

    #[test]
    fn the_usual_step_beside_lost_samples_and_interruptions_is_the_median_step() {
        let mut stamps: Vec<f64> = (0..COUNT).map(|k| 1e-2 * k as f64).collect();
        stamps.retain(|t| !((*t * 1e3) as u64).is_multiple_of(7));
        stamps.iter_mut().skip(2000).for_each(|t| *t += 40.0);
        assert_eq!(usual_step(&stamps), median_step(&stamps));
        for rounding in [1e-3, 1e-2] {
            let rounded = stamps.iter().map(|t| (t * 1.003 / rounding).round());
            let mut rounded: Vec<f64> = rounded.map(|t| t * rounding).collect();
            rounded.dedup();
            assert_eq!(usual_step(&rounded), median_step(&rounded), "{rounding}");
        }
    }

    #[test]
    fn bursts_with_a_lost_packet_and_an_interruption_keep_their_step() {
        let mut stamps = arrived(8, 1e-4, 2e-3);
        stamps.drain(800..808);
        stamps.iter_mut().skip(3000).for_each(|t| *t += 20.0);
        let step = usual_step(&stamps).unwrap();
        // Eight samples of six thousand.
        assert!((step / 1e-2 - 1.0).abs() < 2e-3, "{step}");
    }
}
