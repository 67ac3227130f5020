//! The noise of one sensor, sample by sample.

use nalgebra::Vector3;
use sensor::Sensor;

use super::colour::Colour;
use super::flicker::Flicker;
use super::thermal::Thermal;
use super::{Distribution, Noise, Spikes};
use crate::random::{Purpose, Random};
use crate::spec::SensorSpec;

/// One draw of noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draw {
    /// White noise and drift.
    pub total: Vector3<f64>,
    /// Random walk, instability and thermal drift: the bias less its value at the first sample.
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
    distribution: Distribution,
    colour: Colour,
    spikes: Option<(Spikes, Random)>,
    thermal: Option<Thermal>,
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
            distribution: Distribution::default(),
            colour: Colour::default(),
            spikes: None,
            thermal: None,
        }
    }

    /// With the colour, the distribution, the spikes and the thermal drift that `spec` asks for in a recording
    /// of `length` seconds.
    #[must_use]
    pub fn shaped(
        mut self,
        spec: &SensorSpec,
        rate: f64,
        length: f64,
        seed: u64,
        sensor: Sensor,
    ) -> Self {
        self.distribution = spec.distribution;
        self.colour = Colour::new(spec.low_pass, spec.correlation, rate);
        let spikes = spec.spikes.filter(|s| s.share > 0.0);
        self.spikes = spikes.map(|s| (s, Random::new(seed, Purpose::Spikes(sensor))));
        let moved = spec.thermal_drift;
        self.thermal = (moved > 0.0).then(|| Thermal::new(moved, length * rate, seed, sensor));
        for _ in 0..self.colour.warm_up() {
            self.white();
        }
        self
    }

    fn white(&mut self) -> Vector3<f64> {
        let white = self.distribution.draw3(&mut self.white) * self.white_sigma;
        self.colour.filter(white)
    }

    /// The noise of the next sample.
    pub fn draw(&mut self) -> Draw {
        let mut drift = self.walked + self.flicker.value();
        if let Some(thermal) = &mut self.thermal {
            drift += thermal.value();
            thermal.step();
        }
        let mut total = drift;
        if self.white_sigma > 0.0 {
            total += self.white();
        }
        if let Some((spikes, random)) = &mut self.spikes {
            total += spikes.draw(random);
        }
        if self.walk_sigma > 0.0 {
            self.walked += self.walk.normal3() * self.walk_sigma;
        }
        self.flicker.step();
        Draw { total, drift }
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
