//! Noise of one sensor from its densities.

use nalgebra::Vector3;
use sensor::Sensor;
use serde::{Deserialize, Serialize};

use super::random::{Purpose, Random};

/// Noise densities of one sensor, equal on its three axes; the unit `u` is m/s² or rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Noise {
    /// White noise (velocity or angle random walk) `N`, u/√Hz: a mean over `τ` has the standard
    /// deviation `N/√τ`.
    pub white: f64,
    /// Bias random walk `K`, u/√s: the bias moves by `K√τ` (standard deviation) in a time `τ`.
    pub random_walk: f64,
    /// Bias instability `B`, u: two-sided power spectral density `B²/(2πf)`; the Allan deviation is flat at
    /// `√(2 ln 2/π) B = 0.664 B` (IEEE Std 952).
    pub instability: f64,
}

/// One draw of noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draw {
    /// White noise and drift.
    pub total: Vector3<f64>,
    /// Random walk and instability: the bias less its value at the first sample.
    pub drift: Vector3<f64>,
}

/// Noise samples, one after the other.
#[derive(Clone, Debug)]
pub(crate) struct NoiseSource {
    white_sigma: f64,
    walk_sigma: f64,
    white: Random,
    walk: Random,
    walked: Vector3<f64>,
    flicker: Flicker,
}

impl NoiseSource {
    /// Noise at `rate` samples per second: white noise of `N√rate` and steps of `K/√rate` per sample.
    pub fn new(noise: &Noise, rate: f64, seed: u64, sensor: Sensor) -> Self {
        Self {
            white_sigma: noise.white * rate.sqrt(),
            walk_sigma: noise.random_walk / rate.sqrt(),
            white: Random::new(seed, Purpose::White(sensor)),
            walk: Random::new(seed, Purpose::Walk(sensor)),
            walked: Vector3::zeros(),
            flicker: Flicker::new(noise.instability, rate, seed, sensor),
        }
    }

    /// The noise of the next sample.
    pub fn draw(&mut self) -> Draw {
        let drift = self.walked + self.flicker.value();
        let mut total = drift;
        if self.white_sigma > 0.0 {
            total += self.white.normal3() * self.white_sigma;
        }
        if self.walk_sigma > 0.0 {
            self.walked += self.walk.normal3() * self.walk_sigma;
        }
        self.flicker.step();
        Draw { total, drift }
    }
}

/// Time constants of the Gauss–Markov processes: from 0.1 s, each four times the one before, to 30 h.
const FLICKER_TAU: f64 = 0.1;
const FLICKER_RATIO: f64 = 4.0;
const FLICKER_COUNT: i32 = 11;

/// Flicker noise as a sum of Gauss–Markov processes with time constants evenly spaced in `ln τ`.
///
/// One process of variance `σ²` has the two-sided density `2σ²τ/(1 + (2πfτ)²)`. Summed over `ln τ` in
/// steps of `δ` that makes `σ²/(2fδ)`, so that `σ² = B²δ/π` gives `B²/(2πf)`.
#[derive(Clone, Debug)]
struct Flicker {
    /// Per process: decay per sample, drive per sample, state.
    processes: Vec<(f64, f64, Vector3<f64>)>,
    at_first: Vector3<f64>,
    random: Random,
}

impl Flicker {
    fn new(instability: f64, rate: f64, seed: u64, sensor: Sensor) -> Self {
        let mut random = Random::new(seed, Purpose::Instability(sensor));
        let sigma = instability * (FLICKER_RATIO.ln() / std::f64::consts::PI).sqrt();
        let count = if instability > 0.0 { FLICKER_COUNT } else { 0 };
        let processes: Vec<_> = (0..count)
            .map(|k| {
                let steps = FLICKER_TAU * FLICKER_RATIO.powi(k) * rate;
                let drive = sigma * (-(-2.0 / steps).exp_m1()).sqrt();
                ((-1.0 / steps).exp(), drive, random.normal3() * sigma)
            })
            .collect();
        let at_first = processes.iter().map(|p| p.2).sum();
        Self {
            processes,
            at_first,
            random,
        }
    }

    fn value(&self) -> Vector3<f64> {
        self.processes.iter().map(|p| p.2).sum::<Vector3<f64>>() - self.at_first
    }

    fn step(&mut self) {
        for (decay, drive, state) in &mut self.processes {
            *state = *state * *decay + self.random.normal3() * *drive;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: f64 = 100.0;

    fn drawn(noise: &Noise, rate: f64, seed: u64, count: usize) -> Vec<Vector3<f64>> {
        let mut source = NoiseSource::new(noise, rate, seed, Sensor::Gyroscope);
        (0..count).map(|_| source.draw().total).collect()
    }

    /// Means over `length` neighbouring samples.
    fn means(samples: &[Vector3<f64>], length: usize) -> Vec<Vector3<f64>> {
        let chunks = samples.chunks_exact(length);
        chunks
            .map(|c| c.iter().sum::<Vector3<f64>>() / length as f64)
            .collect()
    }

    /// Mean square over all samples and axes.
    fn mean_square(samples: impl Iterator<Item = Vector3<f64>>) -> f64 {
        let (sum, count) = samples.fold((0.0, 0), |(s, n), v| (s + v.norm_squared(), n + 3));
        sum / f64::from(count)
    }

    #[test]
    fn a_mean_over_one_second_of_white_noise_has_the_density_as_standard_deviation() {
        let density = 2e-3;
        let noise = Noise {
            white: density,
            ..Noise::default()
        };
        let samples = drawn(&noise, RATE, 1, 400_000);
        let single = mean_square(samples.iter().copied()).sqrt();
        let second = mean_square(means(&samples, 100).into_iter()).sqrt();
        // Standard errors 1/√(2·1.2e6) = 0.07 % and 1/√(2·12000) = 0.7 %; four of them.
        assert!((single / (density * RATE.sqrt()) - 1.0).abs() < 0.003);
        assert!((second / density - 1.0).abs() < 0.026);
    }

    #[test]
    fn the_variance_of_a_random_walk_grows_linearly_with_its_density() {
        let density = 3e-5;
        let noise = Noise {
            random_walk: density,
            ..Noise::default()
        };
        let seconds = [1, 4, 16];
        let mut sums = [0.0; 3];
        let seeds = 2000;
        for seed in 0..seeds {
            let walk = drawn(&noise, RATE, seed, 1601);
            for (sum, s) in sums.iter_mut().zip(seconds) {
                *sum += walk[s * 100].norm_squared() / 3.0;
            }
        }
        for (sum, s) in sums.into_iter().zip(seconds) {
            let ratio = sum / seeds as f64 / (density * density * s as f64);
            // Standard error √(2/6000) = 1.8 %; four of them.
            assert!((ratio - 1.0).abs() < 0.073, "{ratio}");
        }
    }

    #[test]
    fn the_processes_of_the_flicker_add_up_to_its_spectrum() {
        let (rate, instability) = (1000.0, 1.0);
        let flicker = Flicker::new(instability, rate, 1, Sensor::Gyroscope);
        for f in [1e-4, 1e-3, 1e-2, 0.1] {
            let density: f64 = (flicker.processes.iter())
                .map(|(decay, drive, _)| {
                    let tau = -1.0 / (rate * decay.ln());
                    let variance = drive * drive / (1.0 - decay * decay);
                    2.0 * variance * tau / (1.0 + (std::f64::consts::TAU * f * tau).powi(2))
                })
                .sum();
            let wanted = instability * instability / (std::f64::consts::TAU * f);
            // Ripple of the sum, and its ends at 0.1 s and 30 h.
            assert!(
                (density / wanted - 1.0).abs() < 0.05,
                "{f}: {}",
                density / wanted
            );
        }
    }

    #[test]
    fn the_allan_deviation_of_the_instability_is_flat_at_two_thirds_of_it() {
        let instability = 1e-4;
        let noise = Noise {
            instability,
            ..Noise::default()
        };
        let rate = 10.0;
        let samples = drawn(&noise, rate, 3, 400_000);
        for tau in [3.0, 10.0, 30.0, 100.0] {
            let means = means(&samples, (tau * rate) as usize);
            let steps = means.windows(2).map(|w| w[1] - w[0]);
            let deviation = (0.5 * mean_square(steps)).sqrt();
            // 400 intervals on three axes at 100 s: a standard error of about 3 %.
            assert!(
                (deviation / (0.664 * instability) - 1.0).abs() < 0.1,
                "{tau}: {deviation}"
            );
        }
    }

    #[test]
    fn one_noise_term_does_not_change_the_draws_of_another() {
        let white = Noise {
            white: 1e-3,
            ..Noise::default()
        };
        let both = Noise {
            random_walk: 1e-4,
            instability: 1e-4,
            ..white
        };
        let mut alone = NoiseSource::new(&white, RATE, 5, Sensor::Accelerometer);
        let mut among = NoiseSource::new(&both, RATE, 5, Sensor::Accelerometer);
        for _ in 0..1000 {
            let (a, b) = (alone.draw(), among.draw());
            assert!((b.total - b.drift - a.total).norm() < 1e-17);
        }
    }
}
