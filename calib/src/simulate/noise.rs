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
