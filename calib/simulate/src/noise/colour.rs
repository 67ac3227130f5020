//! Noise that is not white: through a low pass, or correlated from sample to sample.

use std::f64::consts::{PI, SQRT_2};

use nalgebra::Vector3;

/// Filters with gain 1 at zero frequency, one after the other: a mean over a long time `τ` of filtered white
/// noise keeps its standard deviation `N/√τ`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Colour {
    low_pass: Option<LowPass>,
    /// `x_k = ρ x_{k−1} + (1 − ρ) w_k`: ρ and the last x.
    correlation: Option<(f64, Vector3<f64>)>,
}

/// Samples after which the filters have forgotten their begin, in time constants.
const FORGOTTEN: f64 = 12.0;

impl Colour {
    /// A Butterworth low pass of second order at `low_pass` Hz, and a correlation of neighbouring samples.
    pub fn new(low_pass: Option<f64>, correlation: f64, rate: f64) -> Self {
        Self {
            low_pass: low_pass.map(|cutoff| LowPass::new(cutoff, rate)),
            correlation: (correlation != 0.0).then(|| (correlation, Vector3::zeros())),
        }
    }

    /// White noise to be filtered and thrown away before the first sample.
    pub fn warm_up(&self) -> usize {
        let low_pass = self.low_pass.as_ref().map_or(0.0, |f| f.time_constant);
        let correlated = self
            .correlation
            .map_or(0.0, |(rho, _)| (1.0 - rho.abs()).recip());
        (FORGOTTEN * (low_pass + correlated)).ceil() as usize
    }

    /// The next filtered sample.
    pub fn filter(&mut self, white: Vector3<f64>) -> Vector3<f64> {
        let mut x = white;
        if let Some(low_pass) = &mut self.low_pass {
            x = low_pass.filter(x);
        }
        if let Some((rho, last)) = &mut self.correlation {
            *last = *last * *rho + x * (1.0 - *rho);
            x = *last;
        }
        x
    }
}

/// A Butterworth low pass of second order by the bilinear transformation (Oppenheim & Schafer,
/// Discrete-Time Signal Processing, section 7.3), direct form II transposed.
#[derive(Clone, Debug)]
struct LowPass {
    b: f64,
    a: [f64; 2],
    state: [Vector3<f64>; 2],
    /// Samples.
    time_constant: f64,
}

impl LowPass {
    fn new(cutoff: f64, rate: f64) -> Self {
        let w = (PI * cutoff / rate).tan();
        let norm = (1.0 + SQRT_2 * w + w * w).recip();
        Self {
            b: w * w * norm,
            a: [
                2.0 * (w * w - 1.0) * norm,
                (1.0 - SQRT_2 * w + w * w) * norm,
            ],
            state: [Vector3::zeros(); 2],
            time_constant: rate / (PI * SQRT_2 * cutoff),
        }
    }

    fn filter(&mut self, x: Vector3<f64>) -> Vector3<f64> {
        let [first, second] = self.state;
        let y = x * self.b + first;
        self.state = [
            x * (2.0 * self.b) - y * self.a[0] + second,
            x * self.b - y * self.a[1],
        ];
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude of the answer to a sine of `frequency`, after the begin is forgotten.
    fn gain(mut colour: Colour, frequency: f64, rate: f64) -> f64 {
        let sine = |k: usize| (2.0 * PI * frequency * k as f64 / rate).sin();
        let answer: Vec<f64> = (0..8000)
            .map(|k| colour.filter(Vector3::repeat(sine(k))).x)
            .collect();
        let late = &answer[4000..];
        (2.0 * late.iter().map(|x| x * x).sum::<f64>() / late.len() as f64).sqrt()
    }

    #[test]
    fn the_low_pass_passes_what_is_slow_halves_the_power_at_its_corner_and_stops_what_is_fast() {
        let colour = || Colour::new(Some(10.0), 0.0, 100.0);
        assert!((gain(colour(), 0.1, 100.0) - 1.0).abs() < 1e-3);
        assert!((gain(colour(), 10.0, 100.0) - 0.5_f64.sqrt()).abs() < 1e-3);
        // The bilinear transformation puts the zeros at 50 Hz; at 40 Hz (tan 0.4π / tan 0.1π)² = 89.7.
        assert!((gain(colour(), 40.0, 100.0) - 1.0 / 89.7).abs() < 1e-3);
    }

    #[test]
    fn correlated_noise_has_the_closed_form_gain() {
        let (rho, f, rate) = (0.8, 7.0, 100.0);
        let w = 2.0 * PI * f / rate;
        let expected = (1.0 - rho) / (1.0 - 2.0 * rho * w.cos() + rho * rho).sqrt();
        let found = gain(Colour::new(None, rho, rate), f, rate);
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
}
