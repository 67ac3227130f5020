//! A system under losses, rewritten as least squares at each point.

use std::ops::Range;

use crate::linear::Linearization;
use crate::linear::vector::half_square;
use crate::loss::{Loss, LossScale, RowLoss};
use crate::minimise::system::System;

/// Least curvature of a loss relative to its slope: keeps outliers' rows positive.
pub(crate) const LEAST_CURVATURE: f64 = 1e-2;

/// Median absolute deviation to standard deviation of a Gaussian, `1 / Φ⁻¹(3/4)`.
const MAD_TO_SIGMA: f64 = 1.482_602_218_505_602;

/// Losses of all rows with their scales: one for all, and others for some.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Losses {
    /// The loss of the rows that no group names, and its `σ` (1 for the quadratic loss).
    pub rest: (Loss, f64),
    /// Groups of rows; the first that names a row holds.
    pub groups: Vec<(Range<usize>, Loss, f64)>,
}

impl Losses {
    /// The losses with scales as they are given; 1 where they are to be estimated.
    pub fn new(loss: Loss, groups: &[RowLoss]) -> Self {
        let given = |loss: Loss| match loss.scale() {
            Some(LossScale::Given(scale)) => scale,
            _ => 1.0,
        };
        let group = |g: &RowLoss| (g.rows.clone(), g.loss, given(g.loss));
        Self {
            rest: (loss, given(loss)),
            groups: groups.iter().map(group).collect(),
        }
    }

    /// True where every row counts by its square.
    pub fn is_quadratic(&self) -> bool {
        self.rest.0 == Loss::Quadratic && self.groups.iter().all(|g| g.1 == Loss::Quadratic)
    }

    /// Loss and scale of a row.
    fn of(&self, row: usize) -> (Loss, f64) {
        let named = self.groups.iter().find(|g| g.0.contains(&row));
        named.map_or(self.rest, |g| (g.1, g.2))
    }

    /// The residuals of every loss with its scale to be: `f(loss, residuals, scale)`.
    pub fn rescale(&mut self, residuals: &[f64], f: impl Fn(Loss, &[f64], f64) -> f64) {
        let rows = |keep: &dyn Fn(usize) -> bool| -> Vec<f64> {
            let kept = residuals.iter().enumerate().filter(|(row, _)| keep(*row));
            kept.map(|(_, r)| *r).collect()
        };
        let groups = self.groups.clone();
        let first = |row: usize| groups.iter().position(|g| g.0.contains(&row));
        let rest = rows(&|row| first(row).is_none());
        self.rest.1 = f(self.rest.0, &rest, self.rest.1);
        for (k, group) in self.groups.iter_mut().enumerate() {
            group.2 = f(group.1, &rows(&|row| first(row) == Some(k)), group.2);
        }
    }

    /// The scales of all losses that have one.
    pub fn scales(&self) -> impl Iterator<Item = f64> {
        let groups = self.groups.iter().map(|g| (g.1, g.2));
        let all = std::iter::once(self.rest).chain(groups);
        all.filter(|(loss, _)| loss.scale().is_some())
            .map(|(_, scale)| scale)
    }

    /// Largest `|r| / σ` under a loss that has a scale.
    pub fn largest(&self, residuals: &[f64]) -> f64 {
        let each = residuals.iter().enumerate().map(|(row, r)| {
            let (loss, scale) = self.of(row);
            loss.scale().map_or(0.0, |_| r.abs() / scale)
        });
        each.fold(0.0, f64::max)
    }

    /// Least absolute values, nearly: Huber's loss with a third of the scale in place of every loss.
    pub fn absolute(&self) -> Self {
        let huber = |loss: Loss, scale: f64| match loss.scale() {
            None => (loss, scale),
            Some(_) => (Loss::Huber(LossScale::Given(scale / 3.0)), scale / 3.0),
        };
        let groups = self.groups.iter().map(|(rows, loss, scale)| {
            let (loss, scale) = huber(*loss, *scale);
            (rows.clone(), loss, scale)
        });
        Self {
            rest: huber(self.rest.0, self.rest.1),
            groups: groups.collect(),
        }
    }

    /// Largest robust standard deviation of the residuals under a loss, in its scale.
    pub fn spread(&self, residuals: &[f64]) -> f64 {
        let mut scales = self.clone();
        scales.rescale(residuals, |loss, residuals, scale| {
            loss.scale()
                .map_or(0.0, |_| robust_sigma(residuals) / scale)
        });
        scales.scales().fold(0.0, f64::max)
    }

    /// The same losses, each with the smaller scale of the two.
    pub fn narrower(&self, other: &Self) -> Self {
        let mut both = self.clone();
        both.rest.1 = self.rest.1.min(other.rest.1);
        for (group, other) in both.groups.iter_mut().zip(&other.groups) {
            group.2 = group.2.min(other.2);
        }
        both
    }

    /// Multiplies every scale.
    pub fn widen(&mut self, factor: f64) {
        let wider = |loss: Loss, scale: f64| loss.scale().map_or(scale, |_| scale * factor);
        self.rest.1 = wider(self.rest.0, self.rest.1);
        for group in &mut self.groups {
            group.2 = wider(group.1, group.2);
        }
    }

    /// Half the sum of all losses, infinite where that is not a number.
    pub fn cost(&self, residuals: &[f64]) -> f64 {
        if self.groups.is_empty() {
            return self.rest.0.cost(residuals, self.rest.1);
        }
        let each = residuals.iter().enumerate().map(|(row, r)| {
            let (loss, scale) = self.of(row);
            0.5 * scale * scale * loss.at((r / scale).powi(2))[0]
        });
        let cost = each.sum::<f64>();
        if cost.is_nan() { f64::INFINITY } else { cost }
    }

    /// Weight of every residual: 1 where it counts in full, 0 where not at all.
    pub fn weights(&self, residuals: &[f64]) -> Vec<f64> {
        let each = residuals.iter().enumerate();
        each.map(|(row, &r)| {
            let (loss, scale) = self.of(row);
            loss.weight(r, scale)
        })
        .collect()
    }

    /// Slope and curvature for one residual.
    fn slope_and_curvature(&self, row: usize, residual: f64) -> (f64, f64) {
        let (loss, scale) = self.of(row);
        let s = (residual / scale).powi(2);
        let [_, first, second] = loss.at(s);
        (
            first,
            (first + 2.0 * s * second).max(LEAST_CURVATURE * first),
        )
    }

    /// Factor of `(Jᵀ C J)⁻¹`, `C` the curvatures `ρ′ + 2 s ρ″`, to give the covariance of
    /// the parameters: `K² · Σ (ρ′ r)² / (m − p) / c̄`, with the mean curvature `c̄` and the
    /// correction `K = 1 + (p / m) var(c) / c̄²` for few residuals.
    ///
    /// Source: Huber, "Robust Statistics", 1981, section 7.6.
    pub fn variance(&self, residuals: &[f64], fitted: usize) -> Option<f64> {
        let spare = residuals.len().checked_sub(fitted).filter(|&d| d > 0)? as f64;
        let m = residuals.len() as f64;
        let (mut square, mut sum, mut sum_of_squares) = (0.0, 0.0, 0.0);
        for (row, r) in residuals.iter().enumerate() {
            let (loss, scale) = self.of(row);
            let s = (r / scale).powi(2);
            let [_, first, second] = loss.at(s);
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

/// A system under losses.
///
/// With slope `w = ρ′` and curvature `c = ρ′ + 2 s ρ″` of the loss, residual `w r / √c` and row
/// `√c J` give its exact gradient and its Gauss–Newton Hessian. Source: Triggs, McLauchlan, Hartley
/// and Fitzgibbon, "Bundle adjustment: a modern synthesis", 2000, section 4.3.
pub(crate) struct Robust<'a> {
    /// The system under the losses.
    pub inner: &'a dyn System,
    /// The losses.
    pub losses: Losses,
}

impl System for Robust<'_> {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        self.inner.residuals(z)
    }

    fn cost_of(&self, residuals: &[f64]) -> f64 {
        if self.losses.is_quadratic() {
            return half_square(residuals);
        }
        self.losses.cost(residuals)
    }

    fn linearize(&self, z: &[f64]) -> Linearization {
        let mut at = self.inner.linearize(z);
        at.cost = self.cost_of(&at.residuals);
        let pairs: Vec<(f64, f64)> = (at.residuals.iter().enumerate())
            .map(|(row, &r)| self.losses.slope_and_curvature(row, r))
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
        for (row, (value, r)) in second.iter_mut().zip(residuals).enumerate() {
            *value *= self.losses.slope_and_curvature(row, r).1.sqrt();
        }
        Some(second)
    }

    fn refuses_second_derivatives(&self) -> bool {
        self.inner.refuses_second_derivatives()
    }

    fn offers_second_derivatives(&self) -> bool {
        self.inner.offers_second_derivatives()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variance_is_hubers_for_few_residuals_worked_out_by_hand() {
        // Curvatures 1, 1 and 0; Σ (ρ′ r)² = 0.25 + 0.25 + 1.
        let losses = Losses::new(Loss::Huber(LossScale::Given(1.0)), &[]);
        let few: f64 = 1.0 + 1.0 / 3.0 * (2.0 / 9.0) / (4.0 / 9.0);
        let expected = few * few * 1.5 / 2.0 / (2.0 / 3.0);
        let found = losses.variance(&[0.5, -0.5, 3.0], 1).unwrap();
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        let square = Losses::new(Loss::Quadratic, &[]);
        assert_eq!(square.variance(&[1.0, 2.0, 3.0], 1), Some(7.0));
        assert_eq!(square.variance(&[1.0], 1), None);
    }
}
