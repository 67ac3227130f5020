//! Sensor noise with known coefficients, made independently of the estimator's formulas.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Time constants of the flicker processes: from a twentieth of a sample to twenty recordings.
const MARGIN: f64 = 20.0;

/// The coefficients of the five terms of IEEE Std 952-1997, for a signal in `u`.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients {
    /// Quantisation `Q`, u·s.
    pub quantisation: f64,
    /// White noise `N`, u·√s.
    pub white: f64,
    /// Bias instability `B`, u.
    pub flicker: f64,
    /// Random walk `K`, u/√s.
    pub walk: f64,
    /// Ramp `R`, u/s.
    pub ramp: f64,
}

impl Coefficients {
    /// In the order of `calib::noise::NoiseTerm::ALL`.
    pub fn in_order(&self) -> [f64; 5] {
        [
            self.quantisation,
            self.white,
            self.flicker,
            self.walk,
            self.ramp,
        ]
    }

    /// `samples` samples at intervals of `step` seconds.
    pub fn simulate(&self, samples: usize, step: f64, seed: u64) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
        let mut flicker = Flicker::new(self.flicker, step, samples as f64 * step, &mut normal);
        let (mut walk, mut rounding) = (0.0, normal());
        (0..samples)
            .map(|k| {
                walk += self.walk * step.sqrt() * normal();
                let last = std::mem::replace(&mut rounding, normal());
                self.quantisation * (rounding - last) / step
                    + self.white / step.sqrt() * normal()
                    + flicker.next(&mut normal)
                    + walk
                    + self.ramp * step * k as f64
            })
            .collect()
    }
}

/// `1/f` noise as a sum of first-order Gauss–Markov processes an octave apart.
///
/// Each has variance `σ²` and rate `aᵢ`; over the octaves `Σ 2 σ² aᵢ / (aᵢ² + ω²)` is
/// `π σ² / (ω ln 2)` to one part in a million, which is the two-sided density `B² / (2π f)` of
/// IEEE Std 952-1997, annex C, for `σ² = B² ln 2 / π`.
struct Flicker {
    decay: Vec<f64>,
    state: Vec<f64>,
    sigma: f64,
}

impl Flicker {
    fn new(b: f64, step: f64, duration: f64, normal: &mut impl FnMut() -> f64) -> Self {
        let sigma = b * (std::f64::consts::LN_2 / std::f64::consts::PI).sqrt();
        let slowest = 1.0 / (MARGIN * duration);
        let octaves = (MARGIN / step / slowest).log2().ceil() as i32;
        let decay: Vec<f64> = (0..=octaves)
            .map(|k| (-step * slowest * f64::from(k).exp2()).exp())
            .collect();
        let state = decay.iter().map(|_| sigma * normal()).collect();
        Self {
            decay,
            state,
            sigma,
        }
    }

    fn next(&mut self, normal: &mut impl FnMut() -> f64) -> f64 {
        let mut sum = 0.0;
        for (state, decay) in self.state.iter_mut().zip(&self.decay) {
            *state = decay * *state + self.sigma * (1.0 - decay * decay).sqrt() * normal();
            sum += *state;
        }
        sum
    }
}
