//! Restricted likelihood of a type's mean and covariance, and its maximum.
//!
//! `y_d ~ N(μ, T_d)`, `T_d = Σ + C_d`. With `W_d = T_d⁻¹`, `V = (Σ_d W_d)⁻¹`, `μ = V Σ_d W_d y_d` and `u_d = W_d (y_d − μ)` the
//! likelihood that is left when `μ` is integrated out and its slope are
//!
//! ```text
//! ℓ     = −½ Σ_d ln det T_d + ½ ln det V − ½ Σ_d (y_d − μ)ᵀ u_d
//! ∂ℓ/∂Σ = ½ Σ_d (u_d u_dᵀ − W_d + W_d V W_d)
//! ```
//!
//! A step goes along the slope as `D V` measures it, which of sessions with equal errors is the whole way. It keeps `Σ` from
//! falling below a part of the sessions' errors: maxima on the border, `Σ` zero in a direction, are common, and a prior must
//! not say that a direction is known exactly. Lengths are those of Birgin, Martínez & Raydan 2014, Spectral Projected Gradient
//! Methods, J. Stat. Softw. 60, equation 2.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rayon::prelude::*;

findings::tuning! {
    /// Steps of a fit.
    STEPS: usize = 200;
    /// Variance of the type that a fit has at least, in every direction, against the sessions' mean one. At 2e-3 intervals of 95 %
    /// hold in 89 to 92 of 100 devices of tight types, at 1e-2 in 91 to 93; the more it is, the less a tight type gives.
    LEAST: f64 = 1e-2;
    /// A step may fall below the last likelihood, not below the least of so many: the way is a winding one.
    REMEMBERED: usize = 4;
}

/// Lengths of a step; one that is shorter and still no better ends the fit.
const LENGTHS: (f64, f64) = (0.1, 10.0);
/// Devices whose sums are made together: the order of sums does not depend on the number of threads.
const TOGETHER: usize = 32;

/// Values of a device and the covariance of their errors.
pub(super) type Seen = (DVector<f64>, DMatrix<f64>);

/// Mean and covariance of a type.
#[derive(Clone)]
pub(super) struct Fit {
    /// `μ`.
    pub mu: DVector<f64>,
    /// `Σ`.
    pub sigma: DMatrix<f64>,
    /// `V`, the covariance of the error of `μ`.
    pub of_mu: DMatrix<f64>,
    /// `ℓ`.
    likelihood: f64,
    /// `2/D ∂ℓ/∂Σ`.
    slope: DMatrix<f64>,
}

impl Fit {
    /// The maximum over these devices, from a covariance that is near or from their moments, until a step changes `Σ` by less
    /// than `settled`. None of values that have neither spread nor errors.
    pub(super) fn maximised(
        kept: &[&Seen],
        near: Option<DMatrix<f64>>,
        settled: f64,
    ) -> Option<Self> {
        let least = mean_error(kept) * LEAST.get();
        let start = near.or_else(|| of_moments(kept, &least))?;
        let mut fit = Self::at(start, kept)?;
        let mut seen = vec![fit.likelihood];
        let mut length = 1.0;
        for _ in 0..STEPS.get() {
            let recent = seen.iter().rev().take(REMEMBERED.get()).copied();
            let enough = recent.fold(f64::INFINITY, f64::min) - 1e-9 * fit.likelihood.abs();
            let Some(next) = fit.step(kept, &least, length, enough) else {
                break;
            };
            let change = (&next.sigma - &fit.sigma).amax();
            length = fit.next_length(&next, kept.len()).unwrap_or(1.0);
            seen.push(next.likelihood);
            fit = next;
            if change < settled {
                break;
            }
        }
        Some(fit)
    }

    /// Mean, likelihood and slope at a covariance; none where a `T_d` is no covariance.
    fn at(sigma: DMatrix<f64>, kept: &[&Seen]) -> Option<Self> {
        let p = sigma.nrows();
        let groups: Vec<&[&Seen]> = kept.chunks(TOGETHER).collect();
        let weigh = |group: &&[&Seen]| -> Option<Vec<(DMatrix<f64>, f64)>> {
            group.iter().map(|(_, c)| inverse(&(&sigma + c))).collect()
        };
        let weights: Vec<_> = groups.par_iter().map(weigh).collect::<Option<_>>()?;
        let (mut total, mut sum) = (DMatrix::zeros(p, p), DVector::zeros(p));
        let mut likelihood = 0.0;
        for ((y, _), (w, determinant)) in kept.iter().zip(weights.iter().flatten()) {
            total += w;
            sum += w * y;
            likelihood -= 0.5 * determinant;
        }
        let (of_mu, determinant) = inverse(&total)?;
        likelihood -= 0.5 * determinant;
        let mu = &of_mu * sum;
        let slope_of = |(group, weights): (&&[&Seen], &Vec<(DMatrix<f64>, f64)>)| {
            let (mut slope, mut distances) = (DMatrix::zeros(p, p), 0.0);
            for ((y, _), (w, _)) in group.iter().zip(weights) {
                let gap = y - &mu;
                let u = w * &gap;
                distances += gap.dot(&u);
                slope += w * &of_mu * w - w;
                slope.ger(1.0, &u, &u, 1.0);
            }
            (slope, distances)
        };
        let slopes: Vec<(DMatrix<f64>, f64)> =
            groups.par_iter().zip(&weights).map(slope_of).collect();
        let mut slope = DMatrix::zeros(p, p);
        for (own, distances) in &slopes {
            slope += own;
            likelihood -= 0.5 * distances;
        }
        likelihood.is_finite().then_some(Self {
            mu,
            sigma,
            of_mu,
            likelihood,
            slope: slope / kept.len() as f64,
        })
    }

    /// A step of at most `length` to a likelihood of at least `enough`.
    fn step(
        &self,
        kept: &[&Seen],
        least: &DMatrix<f64>,
        mut length: f64,
        enough: f64,
    ) -> Option<Self> {
        let metric = &self.of_mu * kept.len() as f64;
        let way = &metric * &self.slope * &metric;
        while length > 0.5 * LENGTHS.0 {
            let sigma = raised(&(&self.sigma + &way * length), least, &metric)?;
            let next = Self::at(sigma, kept).filter(|next| next.likelihood >= enough);
            if next.is_some() {
                return next;
            }
            length *= 0.5;
        }
        None
    }

    /// Length that the last step would have had along a parabola; none where the slope has not fallen.
    fn next_length(&self, next: &Self, devices: usize) -> Option<f64> {
        let change = &next.sigma - &self.sigma;
        let fallen = change.dot(&(&self.slope - &next.slope));
        let (weight, _) = inverse(&(&self.of_mu * devices as f64))?;
        let white = weight * change;
        let size = white.dot(&white.transpose());
        (fallen > 0.0).then(|| (size / fallen).clamp(LENGTHS.0, LENGTHS.1))
    }
}

/// Mean of the covariances of the sessions' errors.
fn mean_error(kept: &[&Seen]) -> DMatrix<f64> {
    let p = kept.first().map_or(0, |(y, _)| y.len());
    let sum = kept
        .iter()
        .fold(DMatrix::zeros(p, p), |sum, (_, c)| sum + c);
    sum / kept.len().max(1) as f64
}

/// The covariance of the devices less their sessions' mean one.
fn of_moments(kept: &[&Seen], least: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let p = least.nrows();
    let n = kept.len().max(2) as f64;
    let mean = kept.iter().fold(DVector::zeros(p), |sum, (y, _)| sum + y) / n;
    let whole = kept.iter().fold(DMatrix::zeros(p, p), |sum, (y, _)| {
        let d = y - &mean;
        sum + &d * d.transpose()
    }) / (n - 1.0);
    let error = mean_error(kept);
    raised(&(&whole - &error), least, &error).or(Some(whole))
}

/// The nearest matrix to `x` that is no less than `least` in any direction, distances measured by `metric`.
fn raised(x: &DMatrix<f64>, least: &DMatrix<f64>, metric: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let l = metric.clone().cholesky()?.l();
    let white = l.solve_lower_triangular(&(x - least))?;
    let white = l.solve_lower_triangular(&white.transpose())?;
    let axes = SymmetricEigen::new((&white + white.transpose()) * 0.5);
    let above = axes.eigenvalues.map(|v| v.max(0.0));
    let back = l * axes.eigenvectors;
    let raised = &back * DMatrix::from_diagonal(&above) * back.transpose() + least;
    Some((&raised + raised.transpose()) * 0.5)
}

/// The inverse and `ln det`.
fn inverse(m: &DMatrix<f64>) -> Option<(DMatrix<f64>, f64)> {
    let factor = m.clone().cholesky()?;
    let determinant = 2.0 * factor.l_dirty().diagonal().map(f64::ln).sum();
    Some((factor.inverse(), determinant))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sessions() -> Vec<Seen> {
        let of = |k: usize| {
            let v = |a: usize| ((k * a) % 23) as f64 / 11.0 - 1.0;
            let c = 0.05 + 0.02 * (k % 4) as f64;
            let y = DVector::from_vec(vec![v(7), 0.6 * v(7) + v(5)]);
            (
                y,
                DMatrix::from_row_slice(2, 2, &[c, 0.3 * c, 0.3 * c, 2.0 * c]),
            )
        };
        (0..23).map(of).collect()
    }

    #[test]
    fn the_slope_is_that_of_the_likelihood() {
        let sessions = sessions();
        let kept: Vec<&Seen> = sessions.iter().collect();
        let sigma = DMatrix::from_row_slice(2, 2, &[0.3, 0.1, 0.1, 0.4]);
        let fit = Fit::at(sigma.clone(), &kept).unwrap();
        for (i, j) in [(0, 0), (0, 1), (1, 1)] {
            let at = |step: f64| {
                let mut moved = sigma.clone();
                moved[(i, j)] += step;
                moved[(j, i)] = moved[(i, j)];
                Fit::at(moved, &kept).unwrap().likelihood
            };
            let found = (at(1e-5) - at(-1e-5)) / 2e-5;
            let both = if i == j { 0.5 } else { 1.0 };
            let expected = fit.slope[(i, j)] * both * kept.len() as f64;
            assert!((found - expected).abs() < 1e-5 * expected.abs().max(1.0));
        }
    }

    #[test]
    fn at_the_maximum_the_slope_is_none_wherever_it_began() {
        let sessions = sessions();
        let kept: Vec<&Seen> = sessions.iter().collect();
        let fit = Fit::maximised(&kept, None, 1e-6).unwrap();
        assert!(fit.slope.amax() < 1e-5, "{}", fit.slope);
        let again = Fit::maximised(&kept, Some(DMatrix::identity(2, 2)), 1e-6).unwrap();
        assert!((fit.sigma - again.sigma).amax() < 1e-5);
    }

    #[test]
    fn a_type_that_spreads_by_nothing_keeps_a_part_of_the_errors() {
        let mut sessions = sessions();
        for (y, _) in &mut sessions {
            *y *= 0.1;
        }
        let kept: Vec<&Seen> = sessions.iter().collect();
        let fit = Fit::maximised(&kept, None, 1e-6).unwrap();
        let least = mean_error(&kept) * LEAST.get();
        assert!((fit.sigma - least).amax() < 1e-9);
    }
}
