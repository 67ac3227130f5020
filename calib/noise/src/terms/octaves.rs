//! Generalised least squares of the noise terms to the octaves of a curve.

use std::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::covariance::{PairCovariance, variance};
use super::interval::{Interval, Scatter, invert};
use super::term::NoiseTerm;
use crate::allan::{AllanCurve, AllanPoint};

findings::tuning! {
    /// Rounds of weighting by the scatter that the last fit implies.
    ROUNDS: usize = 8;

    /// Level at which the five terms are taken to miss the curve.
    MISFIT_LEVEL: f64 = 0.01;
}

/// Search range of the relative model error.
const MODEL_ERRORS: (f64, f64) = (1e-4, 3.0);

/// Bisections for it, on its logarithm.
const BISECTIONS: usize = 20;

findings::tuning! {
    /// Octaves below which five terms cannot be told apart.
    pub(crate) FEWEST_POINTS: usize = 6;

    /// A point needs this many times its averaging time in the recording: fewer, and its χ² has less
    /// than two degrees of freedom.
    SPANS: usize = 4;

    /// Confidence of the five intervals of an axis together: each is stated at 99 %.
    JOINT_CONFIDENCE: f64 = 0.95;

    /// Where a memory counts, at least this share of `σ²` is left of the other terms at the shortest time.
    LEFT_BY_MEMORY: f64 = 0.4;

    /// Where no memory counts, less than this share of `σ²` at the shortest time is bias instability, walk and ramp.
    MOST_BY_WALKS: f64 = 0.5;
}

/// Returns true if the recording, gaps left out, has enough room for a point.
pub(crate) fn spans_enough(point: &AllanPoint) -> bool {
    point.places > (SPANS.get() - 2) * point.factor
}

/// The χ² above which a misfit is no accident.
fn limit(freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(f64::INFINITY, |law| {
        law.inverse_cdf(1.0 - MISFIT_LEVEL.get())
    })
}

/// The points fitted, and how they scatter together.
#[derive(Clone)]
pub(crate) struct Octaves {
    pub points: Vec<AllanPoint>,
    covariance: Vec<Vec<PairCovariance>>,
    /// Standard deviation of the model itself, relative to `σ²`.
    pub model_error: f64,
    /// True if readings that are near in time go together (a filter, say): past that memory it takes `c/τ²` off `σ²`, as a
    /// negative squared quantisation would.
    pub has_memory: bool,
}

impl Octaves {
    pub fn of(curve: &AllanCurve) -> Option<Self> {
        let points: Vec<AllanPoint> = curve
            .points
            .iter()
            .filter(|p| p.factor.is_power_of_two() && spans_enough(p))
            .copied()
            .collect();
        let varied = points
            .iter()
            .all(|p| p.deviation > 0.0 && p.deviation.is_finite());
        if points.len() < FEWEST_POINTS.get() || !varied {
            return None;
        }
        let covariance = (0..points.len())
            .map(|i| {
                (0..=i)
                    .map(|j| {
                        let both = [points[j], points[i]];
                        PairCovariance::new(
                            both.map(|p| p.factor),
                            both.map(|p| p.places),
                            curve.step,
                        )
                    })
                    .collect()
            })
            .collect();
        Some(Self {
            points,
            covariance,
            model_error: 0.0,
            has_memory: false,
        })
    }

    /// The octaves of this range, none of which lies within the memory of the readings if the first are left out.
    pub fn part(&self, range: Range<usize>) -> Self {
        let rows = &self.covariance[range.clone()];
        Self {
            points: self.points[range.clone()].to_vec(),
            covariance: rows.iter().map(|row| row[range.start..].to_vec()).collect(),
            model_error: 0.0,
            has_memory: range.start > 0,
        }
    }

    /// Returns true if the terms miss the points by no more than chance does, and what scatters from reading to reading leads
    /// them: readings that only wander are filtered ones, and a filter looks like a walk of the bias at times within its memory.
    pub fn are_explained(&self) -> bool {
        let Some(theta) = self.settle() else {
            return false;
        };
        self.are_led_by_scatter(&theta)
            && self
                .chi2(&theta)
                .is_some_and(|chi2| chi2 <= limit(self.freedom(&theta)))
    }

    fn are_led_by_scatter(&self, theta: &[f64; 5]) -> bool {
        let mut slow = *theta;
        slow[NoiseTerm::Quantisation as usize] = 0.0;
        slow[NoiseTerm::WhiteNoise as usize] = 0.0;
        let share = |p: &AllanPoint| variance(p.tau, &slow) / variance(p.tau, theta);
        self.points
            .first()
            .is_some_and(|p| share(p) < MOST_BY_WALKS.get())
    }

    /// White noise through the first point: a start that every sensor is near at short times.
    fn first_guess(&self) -> [f64; 5] {
        let mut theta = [0.0; 5];
        for (term, theta) in NoiseTerm::ALL.iter().zip(&mut theta) {
            let share = |p: &AllanPoint| p.deviation.powi(2) / term.variance(p.tau);
            *theta = self.points.iter().map(share).fold(f64::INFINITY, f64::min) / 5.0;
        }
        theta
    }

    /// The squared coefficients, weighted by the scatter that they imply.
    pub fn settle(&self) -> Option<[f64; 5]> {
        let mut theta = self.first_guess();
        for _ in 0..ROUNDS.get() {
            theta = self.weighted(&theta)?.nonnegative(None);
        }
        Some(theta)
    }

    /// Finds the smallest model error that explains the misfit.
    pub fn fit_model_error(&mut self) {
        if self
            .misfit()
            .is_none_or(|(chi2, freedom)| chi2 <= limit(freedom))
        {
            return;
        }
        let (mut low, mut high) = MODEL_ERRORS;
        for _ in 0..BISECTIONS {
            self.model_error = (low * high).sqrt();
            match self.misfit() {
                Some((chi2, freedom)) if chi2 < freedom => high = self.model_error,
                _ => low = self.model_error,
            }
        }
    }

    /// χ² of the fit and its degrees of freedom.
    fn misfit(&self) -> Option<(f64, f64)> {
        let theta = self.settle()?;
        Some((self.chi2(&theta)?, self.freedom(&theta)))
    }

    fn chi2(&self, theta: &[f64; 5]) -> Option<f64> {
        Some(self.weighted(theta)?.chi2(theta))
    }

    /// Returns true if squared coefficients are possible ones.
    fn allow(&self, theta: &[f64; 5]) -> bool {
        let [memory, others @ ..] = theta;
        if others.iter().any(|&t| t < 0.0) || (*memory < 0.0 && !self.has_memory) {
            return false;
        }
        let left = |p: &AllanPoint| {
            let whole = variance(p.tau, &[0.0, theta[1], theta[2], theta[3], theta[4]]);
            variance(p.tau, theta) >= LEFT_BY_MEMORY.get() * whole
        };
        self.points.first().is_none_or(left)
    }

    fn freedom(&self, theta: &[f64; 5]) -> f64 {
        let used = theta.iter().filter(|&&t| t != 0.0).count();
        self.points.len().saturating_sub(used).max(1) as f64
    }

    /// The covariance matrix of the points, each divided by its `scale`, for squared coefficients
    /// `theta`.
    fn matrix(&self, theta: &[f64; 5], scale: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(scale.len(), scale.len(), |i, j| {
            self.covariance[i.max(j)][i.min(j)].at(theta) / (scale[i] * scale[j])
        })
    }

    /// The problem with the scatter that `theta` implies.
    pub fn weighted(&self, theta: &[f64; 5]) -> Option<Weighted<'_>> {
        let scale: Vec<f64> = self.points.iter().map(|p| variance(p.tau, theta)).collect();
        let mut matrix = self.matrix(theta, &scale);
        for k in 0..scale.len() {
            matrix[(k, k)] += self.model_error.powi(2);
        }
        let root = Cholesky::new(matrix)?;
        let lower = root.l();
        let n = self.points.len();
        let design = DMatrix::from_fn(n, 5, |i, k| {
            NoiseTerm::ALL[k].variance(self.points[i].tau) / scale[i]
        });
        let data = DVector::from_fn(n, |i, _| self.points[i].deviation.powi(2) / scale[i]);
        Some(Weighted {
            octaves: self,
            design: lower.solve_lower_triangular(&design)?,
            data: lower.solve_lower_triangular(&data)?,
            scale,
            root,
        })
    }
}

/// `‖d − A θ‖²` with whitened rows.
pub(crate) struct Weighted<'a> {
    octaves: &'a Octaves,
    design: DMatrix<f64>,
    data: DVector<f64>,
    scale: Vec<f64>,
    root: Cholesky<f64, Dyn>,
}

impl Weighted<'_> {
    fn chi2(&self, theta: &[f64; 5]) -> f64 {
        (&self.data - &self.design * DVector::from_row_slice(theta)).norm_squared()
    }

    /// The least-squares values of `terms` with the others held at `theta`; `None` where collinear.
    ///
    /// By the normal equations of whitened columns, whose slopes are far apart.
    fn solve(&self, terms: &[usize], theta: &[f64; 5]) -> Option<[f64; 5]> {
        let mut rest = *theta;
        terms.iter().for_each(|&k| rest[k] = 0.0);
        let data = &self.data - &self.design * DVector::from_row_slice(&rest);
        let columns = self.design.select_columns(terms);
        let values = Cholesky::new(columns.tr_mul(&columns))?.solve(&columns.tr_mul(&data));
        terms
            .iter()
            .zip(values.iter())
            .for_each(|(&k, &value)| rest[k] = value);
        Some(rest)
    }

    /// The best squared coefficients that are not negative, but for what a memory takes off, by trying every subset of
    /// the terms; the term `held`, if any, keeps its value.
    pub fn nonnegative(&self, held: Option<(usize, f64)>) -> [f64; 5] {
        let mut start = [0.0; 5];
        if let Some((k, value)) = held {
            start[k] = value;
        }
        let mut best = (start, self.chi2(&start));
        for subset in 1..32_usize {
            if held.is_some_and(|(k, _)| subset >> k & 1 == 1) {
                continue;
            }
            let terms: Vec<usize> = (0..5).filter(|k| subset >> k & 1 == 1).collect();
            let Some(theta) = self.solve(&terms, &start).filter(|t| self.octaves.allow(t)) else {
                continue;
            };
            let chi2 = self.chi2(&theta);
            if chi2 < best.1 {
                best = (theta, chi2);
            }
        }
        best.0
    }

    /// The interval of squared coefficient `k`: the values under which the estimate with all five
    /// terms of either sign, a fixed linear combination of the points, would not be surprising. The
    /// other four are fitted anew for every value tried, because the scatter depends on them.
    pub fn interval(&self, k: usize) -> Option<Interval> {
        let estimate = self.solve(&[0, 1, 2, 3, 4], &[0.0; 5])?[k];
        let gram = Cholesky::new(self.design.tr_mul(&self.design))?;
        let mut unit = DVector::zeros(5);
        unit[k] = 1.0;
        let row = &self.design * gram.solve(&unit);
        let weights = self.root.l().transpose().solve_upper_triangular(&row)?;
        let scatter = |value: f64| self.scatter(&weights, &self.nonnegative(Some((k, value))));
        Some(invert(
            1.0 - (1.0 - JOINT_CONFIDENCE.get()) / 5.0,
            estimate,
            scatter,
        ))
    }

    /// The scatter of `Σ wᵢ σ²ᵢ/scaleᵢ` for squared coefficients `theta`.
    ///
    /// An Allan variance `v` scatters like `v χ²_ν/ν`, whose third moment is `2 Var²/v`; for a sum
    /// of correlated ones, with covariance `C`, that becomes `2 Σ wᵢ (C w)ᵢ² / vᵢ`.
    fn scatter(&self, weights: &DVector<f64>, theta: &[f64; 5]) -> Scatter {
        let spread = self.octaves.matrix(theta, &self.scale) * weights;
        let third = (0..weights.len()).map(|i| {
            let implied = variance(self.octaves.points[i].tau, theta) / self.scale[i];
            2.0 * weights[i] * spread[i].powi(2) / implied.max(f64::MIN_POSITIVE)
        });
        Scatter {
            variance: weights.dot(&spread),
            third: third.sum(),
        }
    }
}
