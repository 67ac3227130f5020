//! Flicker noise: a bias whose spectrum goes with 1/f.

use nalgebra::Vector3;
use sensor::Sensor;

use crate::random::{Purpose, Random};

/// Time constants of the Gauss–Markov processes: from 0.1 s, each four times the one before, to 30 h.
const FLICKER_TAU: f64 = 0.1;
const FLICKER_RATIO: f64 = 4.0;
const FLICKER_COUNT: i32 = 11;

/// Flicker noise as a sum of Gauss–Markov processes with time constants evenly spaced in `ln τ`.
///
/// One process of variance `σ²` has the two-sided density `2σ²τ/(1 + (2πfτ)²)`. Summed over `ln τ` in
/// steps of `δ` that makes `σ²/(2fδ)`, so that `σ² = B²δ/π` gives `B²/(2πf)`.
#[derive(Clone, Debug)]
pub(crate) struct Flicker {
    /// Per process: decay per sample, drive per sample, state.
    processes: Vec<(f64, f64, Vector3<f64>)>,
    at_first: Vector3<f64>,
    random: Random,
}

impl Flicker {
    pub fn new(instability: f64, rate: f64, seed: u64, sensor: Sensor) -> Self {
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

    pub fn value(&self) -> Vector3<f64> {
        self.processes.iter().map(|p| p.2).sum::<Vector3<f64>>() - self.at_first
    }

    pub fn step(&mut self) {
        for (decay, drive, state) in &mut self.processes {
            *state = *state * *decay + self.random.normal3() * *drive;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
