//! Covariance of the overlapping Allan variances of one recording.
//!
//! The estimates at different averaging times share their samples; a fit that ignores it states
//! intervals that are far too narrow. With `D_m(n) = x_{n+2m} − 2 x_{n+m} + xₙ` (Gaussian) and
//! `R₁₂(k)` the covariance of `D_{m₁}(n)` and `D_{m₂}(n+k)`,
//!
//! ```text
//! Cov(σ²(m₁), σ²(m₂)) = Σₖ w(k) (2 R₁₂(k)² + 4 μ₁ μ₂ R₁₂(k)) / (4 τ₁² τ₂² M₁ M₂)
//! ```
//!
//! where `w(k)` counts the pairs at lag `k` and `μ = R τ²` is the mean that a ramp gives. `R₁₂` is
//! the double second difference of the generalised autocovariance `s(t)` of the integrated signal
//! (C. A. Greenhall and W. J. Riley, Uncertainty of stability variances based on finite differences,
//! 35th PTTI Meeting, 2003).

use super::term::NoiseTerm;

/// The four random terms, in the order of [`NoiseTerm::ALL`]; the fifth, the ramp, is a mean.
const RANDOM: usize = 4;

/// `Cov(σ²(τ₁), σ²(τ₂))` as a quadratic form in the squared coefficients of the five terms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairCovariance {
    quadratic: [[f64; 5]; 5],
}

impl PairCovariance {
    /// For averaging factors `m₁ ≤ m₂` with so many places each, samples `step` seconds apart. Of a recording in pieces the places count
    /// as if they followed each other, which overstates the scatter rather than not.
    pub(crate) fn new(m: [usize; 2], places: [usize; 2], step: f64) -> Self {
        let places = places.map(|places| places.max(1) as f64);
        let lags = Lags {
            m: m.map(|m| m as f64),
            places,
            step,
        };
        let tau = m.map(|m| m as f64 * step);
        let scale = 1.0 / (4.0 * (tau[0] * tau[1]).powi(2) * places[0] * places[1]);
        let mut quadratic = [[0.0; 5]; 5];
        let mut add = |weight: f64, r: [f64; RANDOM]| {
            for (a, &ra) in r.iter().enumerate() {
                for (b, &rb) in r.iter().enumerate() {
                    quadratic[a][b] += weight * scale * 2.0 * ra * rb;
                }
                quadratic[a][RANDOM] += weight * scale * 4.0 * (tau[0] * tau[1]).powi(2) * ra;
            }
        };
        for (k, weight) in lags.smooth() {
            let r = lags.covariance(k);
            add(weight, [0.0, r[1], r[2], r[3]]);
        }
        // White noise of the integral lives at single lags only: its squares and its products with
        // the smooth terms are sums of a few numbers, which no quadrature sees.
        for k in lags.coincidences() {
            let r = lags.covariance(k);
            let weight = lags.pairs(k);
            add(weight, r);
            add(-weight, [0.0, r[1], r[2], r[3]]);
        }
        Self { quadratic }
    }

    /// The covariance for squared coefficients `theta`.
    pub(crate) fn at(&self, theta: &[f64; 5]) -> f64 {
        let row = |a: usize| -> f64 {
            self.quadratic[a]
                .iter()
                .zip(theta)
                .map(|(q, t)| q * t)
                .sum::<f64>()
                * theta[a]
        };
        (0..5).map(row).sum()
    }
}

/// The lags between the differences at two averaging factors.
struct Lags {
    m: [f64; 2],
    places: [f64; 2],
    step: f64,
}

impl Lags {
    /// `R₁₂(k)` of each random term with coefficient 1.
    fn covariance(&self, k: f64) -> [f64; RANDOM] {
        let mut r = [0.0; RANDOM];
        for (j, weight) in [1.0, -2.0, 1.0].into_iter().enumerate() {
            let centre = k + j as f64 * self.m[1] - self.m[0];
            let s = second_difference(centre, self.m[0]);
            r.iter_mut().zip(s).for_each(|(r, s)| *r += weight * s);
        }
        for (power, r) in r.iter_mut().enumerate() {
            *r *= self.step.powi(power as i32);
        }
        r
    }

    /// The number of pairs of places `k` apart.
    fn pairs(&self, k: f64) -> f64 {
        (self.places[0].min(self.places[1] - k) - (-k).max(0.0)).max(0.0)
    }

    /// The lags at which a point of one difference meets a point of the other.
    fn coincidences(&self) -> Vec<f64> {
        let mut lags: Vec<f64> = (0..9)
            .map(|n| f64::from(n / 3) * self.m[0] - f64::from(n % 3) * self.m[1])
            .collect();
        lags.sort_by(f64::total_cmp);
        lags.dedup();
        lags
    }

    /// Lags and weights of a quadrature for `Σₖ w(k) f(k)`.
    ///
    /// `f` bends within a few `m₁` of the coincidences and is smooth elsewhere: nodes are an eighth
    /// of `m₁` apart there (never below one sample, where the sum is exact) and spread out
    /// geometrically away from it.
    fn smooth(&self) -> Vec<(f64, f64)> {
        let (first, last) = (1.0 - self.places[0], self.places[1] - 1.0);
        let mut nodes = vec![first, last];
        for centre in [0.0, -self.m[1], -2.0 * self.m[1]] {
            for side in [-1.0, 1.0] {
                let middle = centre + self.m[0];
                let (mut away, mut node) = (0.0, middle);
                while node >= first && node <= last {
                    nodes.push(node);
                    away += (self.m[0] / 8.0)
                        .max(1.0)
                        .max(0.12 * (away - 4.0 * self.m[0]));
                    node = (middle + side * away).round();
                }
            }
        }
        nodes.retain(|&k| k >= first && k <= last);
        nodes.sort_by(f64::total_cmp);
        nodes.dedup();
        (0..nodes.len())
            .map(|n| {
                let before = if n == 0 { nodes[0] - 1.0 } else { nodes[n - 1] };
                let after = nodes.get(n + 1).copied().unwrap_or(nodes[n] + 1.0);
                (nodes[n], self.pairs(nodes[n]) * 0.5 * (after - before))
            })
            .collect()
    }
}

/// `s(t + m) − 2 s(t) + s(t − m)` of the integral of each random term with coefficient 1, in samples.
///
/// `s = δ(t), −|t|/2, t² ln|t| / 2π, |t|³/12`: the factors follow from
/// `2 τ² σ²(τ) = Var D(τ) = 6 s(0) − 8 s(τ) + 2 s(2τ)`. Away from zero the difference is written
/// out, because that of the plain formula has no digits left there.
fn second_difference(t: f64, m: f64) -> [f64; RANDOM] {
    let t = t.abs();
    let plain = |s: fn(f64) -> f64| s(t + m) - 2.0 * s(t) + s((t - m).abs());
    let flicker = if t > 64.0 * m {
        m * m * (2.0 * t.ln() + 3.0) - (m * m / t).powi(2) / 6.0
    } else {
        plain(|t| if t > 0.0 { t * t * t.ln() } else { 0.0 })
    };
    let beyond = t >= m;
    [
        plain(|t| if t == 0.0 { 1.0 } else { 0.0 }),
        if beyond { 0.0 } else { -0.5 * plain(|t| t) },
        flicker / std::f64::consts::TAU,
        if beyond {
            0.5 * t * m * m
        } else {
            plain(|t| t * t * t) / 12.0
        },
    ]
}

/// `σ²(τ)` for squared coefficients `theta`.
pub(crate) fn variance(tau: f64, theta: &[f64; 5]) -> f64 {
    NoiseTerm::ALL
        .iter()
        .zip(theta)
        .map(|(term, t)| t * term.variance(tau))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// White noise at the shortest averaging time has `D = y₁ − y₀`: `R(0) = 2σ²`, `R(±1) = −σ²`, so
    /// that `Var σ² = (2/4M²) σ⁴ (4M + 2(M − 1))`.
    #[test]
    fn white_noise_at_the_first_lag_scatters_as_counted_by_hand() {
        let samples = 1000;
        let pairs = 999.0;
        let by_hand = (4.0 * pairs + 2.0 * (pairs - 1.0)) * 2.0 / (4.0 * pairs * pairs);
        let found =
            PairCovariance::new([1, 1], [samples - 1; 2], 1.0).at(&[0.0, 1.0, 0.0, 0.0, 0.0]);
        assert!((found / by_hand - 1.0).abs() < 1e-12, "{found} {by_hand}");
    }

    /// White noise of the integral: `R = 6, −4, 1` at lags 0, ±m, ±2m.
    #[test]
    fn quantisation_at_any_lag_scatters_as_counted_by_hand() {
        let (samples, m) = (5000, 8);
        let pairs = (samples + 1 - 2 * m) as f64;
        let count = |k: usize| pairs - k as f64;
        let sum = 36.0 * pairs + 2.0 * 16.0 * count(m) + 2.0 * count(2 * m);
        let by_hand = 2.0 * sum / (4.0 * (m as f64).powi(4) * pairs * pairs);
        let found = PairCovariance::new([m, m], [samples + 1 - 2 * m; 2], 1.0)
            .at(&[1.0, 0.0, 0.0, 0.0, 0.0]);
        assert!((found / by_hand - 1.0).abs() < 1e-12, "{found} {by_hand}");
    }

    /// The quadrature against the sum over every lag.
    #[test]
    fn the_quadrature_agrees_with_the_sum_over_every_lag() {
        let theta = [0.3, 1.0, 0.2, 0.01, 1e-5];
        for m in [[1, 1], [1, 64], [16, 16], [8, 512], [256, 512], [512, 512]] {
            let samples = 3000;
            let places = m.map(|m| (samples + 1 - 2 * m) as f64);
            let lags = Lags {
                m: m.map(|m| m as f64),
                places,
                step: 0.5,
            };
            let tau = m.map(|m| m as f64 * 0.5);
            let mut sum = 0.0;
            for k in 1 - places[0] as i64..places[1] as i64 {
                let r: f64 = lags
                    .covariance(k as f64)
                    .iter()
                    .zip(&theta)
                    .map(|(r, t)| r * t)
                    .sum();
                let mean = theta[4] * (tau[0] * tau[1]).powi(2);
                sum += lags.pairs(k as f64) * (2.0 * r * r + 4.0 * mean * r);
            }
            let direct = sum / (4.0 * (tau[0] * tau[1]).powi(2) * places[0] * places[1]);
            let found = PairCovariance::new(m, m.map(|m| samples + 1 - 2 * m), 0.5).at(&theta);
            // Two per cent of a variance is one per cent of an error bar.
            assert!(
                (found / direct - 1.0).abs() < 0.02,
                "{m:?}: {found} {direct}"
            );
        }
    }
}
