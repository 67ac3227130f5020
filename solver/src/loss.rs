//! Robust losses.

use serde::{Deserialize, Serialize};

use crate::linear::Linearization;
use crate::system::System;

/// What a residual costs: `½ σ² Σ ρ((rᵢ / σ)²)` with `ρ(s) = s` for the quadratic loss.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Loss {
    /// `ρ = s`: least squares.
    #[default]
    Quadratic,
    /// `ρ = s` up to 1, then `2 √s − 1`: outliers count by their size.
    Huber(LossScale),
    /// `ρ = ln(1 + s)`: outliers count ever less.
    Cauchy(LossScale),
    /// `ρ = (1 − (1 − s)³) / 3` up to 1, then `1/3`: outliers do not count at all.
    Tukey(LossScale),
}

/// The residual `σ` at which a loss bends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LossScale {
    /// In the unit of the residuals.
    Given(f64),
    /// This many robust standard deviations, `1.4826 · median |r|`, estimated along with the
    /// parameters in at most 30 rounds. For 95 % efficiency on Gaussian residuals: Huber 1.345, Cauchy 2.385,
    /// Tukey 4.685.
    Estimated(f64),
}

/// Least curvature of the loss relative to its slope: keeps outliers' rows positive.
const LEAST_CURVATURE: f64 = 1e-2;

/// Median absolute deviation to standard deviation of a Gaussian, `1 / Φ⁻¹(3/4)`.
const MAD_TO_SIGMA: f64 = 1.482_602_218_505_602;

impl Loss {
    /// Its scale, if it has one.
    pub fn scale(self) -> Option<LossScale> {
        match self {
            Self::Quadratic => None,
            Self::Huber(scale) | Self::Cauchy(scale) | Self::Tukey(scale) => Some(scale),
        }
    }

    /// `ρ`, `ρ′` and `ρ″` at `s = (r / σ)²`.
    fn at(self, s: f64) -> [f64; 3] {
        match self {
            Self::Quadratic => [s, 1.0, 0.0],
            Self::Huber(_) if s <= 1.0 => [s, 1.0, 0.0],
            Self::Huber(_) => {
                let root = s.sqrt();
                [2.0 * root - 1.0, 1.0 / root, -0.5 / (s * root)]
            }
            Self::Cauchy(_) => [s.ln_1p(), 1.0 / (1.0 + s), -(1.0 + s).powi(-2)],
            Self::Tukey(_) if s <= 1.0 => {
                let u = 1.0 - s;
                [(1.0 - u.powi(3)) / 3.0, u * u, -2.0 * u]
            }
            Self::Tukey(_) => [1.0 / 3.0, 0.0, 0.0],
        }
    }

    /// `½ σ² Σ ρ((r / σ)²)`, infinite where that is not a number.
    pub(crate) fn cost(self, residuals: &[f64], scale: f64) -> f64 {
        let each = residuals.iter().map(|r| self.at((r / scale).powi(2))[0]);
        let cost = 0.5 * scale * scale * each.sum::<f64>();
        if cost.is_nan() { f64::INFINITY } else { cost }
    }

    /// `½ σ² ρ(s)` of a factor of `‖r‖²`, `s = ‖r‖² / σ²`, for a scale that is given; without one `½ ‖r‖²`.
    pub(crate) fn cost_of_square(self, square: f64) -> f64 {
        let variance = self.given_variance();
        0.5 * variance * self.at(square / variance)[0]
    }

    /// `ρ′(s)` and `ρ″(s) / σ²`, `s = ‖r‖² / σ²`.
    pub(crate) fn slope_and_bend(self, square: f64) -> (f64, f64) {
        let variance = self.given_variance();
        let [_, first, second] = self.at(square / variance);
        (first, second / variance)
    }

    fn given_variance(self) -> f64 {
        match self.scale() {
            Some(LossScale::Given(scale) | LossScale::Estimated(scale)) => scale * scale,
            None => 1.0,
        }
    }

    /// The same loss with a scale that is known.
    pub(crate) fn with_scale(self, scale: f64) -> Self {
        let given = LossScale::Given(scale);
        match self {
            Self::Quadratic => Self::Quadratic,
            Self::Huber(_) => Self::Huber(given),
            Self::Cauchy(_) => Self::Cauchy(given),
            Self::Tukey(_) => Self::Tukey(given),
        }
    }

    /// What multiplies `(Jᵀ C J)⁻¹`, `C` the curvatures `ρ′ + 2 s ρ″`, to give the covariance of
    /// the parameters: `K² · Σ (ρ′ r)² / (m − p) / c̄`, with the mean curvature `c̄` and the
    /// correction `K = 1 + (p / m) var(c) / c̄²` for few residuals.
    ///
    /// Source: Huber, "Robust Statistics", 1981, section 7.6.
    pub(crate) fn variance(self, residuals: &[f64], scale: f64, fitted: usize) -> Option<f64> {
        let spare = residuals.len().checked_sub(fitted).filter(|&d| d > 0)? as f64;
        let m = residuals.len() as f64;
        let (mut square, mut sum, mut sum_of_squares) = (0.0, 0.0, 0.0);
        for r in residuals {
            let s = (r / scale).powi(2);
            let [_, first, second] = self.at(s);
            let curvature = if first > 0.0 {
                first + 2.0 * s * second
            } else {
                0.0
            };
            square += (first * r).powi(2);
            sum += curvature;
            sum_of_squares += curvature * curvature;
        }
        let mean = sum / m;
        let spread = (sum_of_squares / m - mean * mean).max(0.0);
        let few = 1.0 + fitted as f64 / m * spread / (mean * mean);
        let variance = few * few * square / spare / mean;
        (mean > 0.0 && variance.is_finite()).then_some(variance)
    }

    /// The weight `ρ′((r / σ)²)` of a residual: 1 where it counts in full, 0 where not at all.
    pub fn weight(self, residual: f64, scale: f64) -> f64 {
        self.at((residual / scale).powi(2))[1]
    }
}

/// `1.4826 · median |r|`; the root mean square where more than half of the residuals are zero.
pub(crate) fn robust_sigma(residuals: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let middle = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    if middle > 0.0 {
        return MAD_TO_SIGMA * middle;
    }
    (sizes.iter().map(|r| r * r).sum::<f64>() / sizes.len().max(1) as f64).sqrt()
}

/// A system under a loss, rewritten as least squares at each point.
///
/// With slope `w = ρ′` and curvature `c = ρ′ + 2 s ρ″` of the loss, residual `w r / √c` and row
/// `√c J` give its exact gradient and its Gauss–Newton Hessian. Source: Triggs, McLauchlan, Hartley
/// and Fitzgibbon, "Bundle adjustment: a modern synthesis", 2000, section 4.3.
pub(crate) struct Robust<'a> {
    /// The system under the loss.
    pub inner: &'a dyn System,
    /// The loss.
    pub loss: Loss,
    /// Its `σ`.
    pub scale: f64,
}

impl Robust<'_> {
    /// Slope and curvature for one residual.
    fn slope_and_curvature(&self, residual: f64) -> (f64, f64) {
        let s = (residual / self.scale).powi(2);
        let [_, first, second] = self.loss.at(s);
        (
            first,
            (first + 2.0 * s * second).max(LEAST_CURVATURE * first),
        )
    }
}

impl System for Robust<'_> {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        self.inner.residuals(z)
    }

    fn cost_of(&self, residuals: &[f64]) -> f64 {
        self.loss.cost(residuals, self.scale)
    }

    fn linearize(&self, z: &[f64]) -> Linearization {
        let mut at = self.inner.linearize(z);
        at.cost = self.cost_of(&at.residuals);
        let pairs: Vec<(f64, f64)> = at
            .residuals
            .iter()
            .map(|&r| self.slope_and_curvature(r))
            .collect();
        let roots: Vec<f64> = pairs.iter().map(|(_, c)| c.sqrt()).collect();
        for ((r, (slope, _)), root) in at.residuals.iter_mut().zip(&pairs).zip(&roots) {
            if r.is_finite() {
                *r = if *root > 0.0 { *r * slope / root } else { 0.0 };
            }
        }
        at.jacobian.scale_rows(&roots);
        at
    }

    fn culprit(&self, z: &[f64], row: usize) -> Option<usize> {
        self.inner.culprit(z, row)
    }

    fn second_derivative(&self, z: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        // To leading order; the change of the weights along v is left out.
        let residuals = self.inner.residuals(z);
        let mut second = self.inner.second_derivative(z, v)?;
        for (value, r) in second.iter_mut().zip(residuals) {
            *value *= self.slope_and_curvature(r).1.sqrt();
        }
        Some(second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_and_curvatures_are_the_derivatives_of_the_loss() {
        let scale = LossScale::Given(1.0);
        for loss in [
            Loss::Quadratic,
            Loss::Huber(scale),
            Loss::Cauchy(scale),
            Loss::Tukey(scale),
        ] {
            for s in [0.1, 0.7, 1.3, 9.0] {
                let h = 1e-5;
                let ([below, slope_below, _], [above, slope_above, _]) =
                    (loss.at(s - h), loss.at(s + h));
                let [_, first, second] = loss.at(s);
                assert!(
                    (first - (above - below) / (2.0 * h)).abs() < 1e-9,
                    "{loss:?} {s}"
                );
                assert!(
                    (second - (slope_above - slope_below) / (2.0 * h)).abs() < 1e-9,
                    "{loss:?} {s}"
                );
            }
        }
    }
}
