//! Identification of the noise terms of a recording, with confidence intervals.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::allan::{AllanCurve, AllanPoint};
use super::covariance::{PairCovariance, variance};
use super::interval::{Interval, Scatter, invert};
use super::term::NoiseTerm;

/// Rounds of weighting by the scatter that the last fit implies.
const ROUNDS: usize = 8;

/// Level at which the five terms are taken to miss the curve.
const MISFIT_LEVEL: f64 = 0.01;

/// Search range of the relative model error.
const MODEL_ERRORS: (f64, f64) = (1e-4, 3.0);

/// Bisections for it, on its logarithm.
const BISECTIONS: usize = 20;

/// Octaves below which five terms cannot be told apart.
const FEWEST_POINTS: usize = 6;

/// A point needs this many times its averaging time in the recording: fewer, and its χ² has less
/// than two degrees of freedom.
const SPANS: usize = 4;

/// Confidence of the five intervals of an axis together: each is stated at 99 %.
const JOINT_CONFIDENCE: f64 = 0.95;

/// Confidence of the interval of one measured point.
const POINT_CONFIDENCE: f64 = 0.95;

/// A noise coefficient with its interval, in the unit of [`NoiseTerm::unit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The term.
    pub term: NoiseTerm,
    /// Its coefficient; zero where the fit does without.
    pub value: f64,
    /// The five intervals of an axis hold together with 95 % confidence (each with 99 %).
    pub interval: Interval,
}

impl Estimate {
    /// Returns true if the data need this term.
    pub fn is_seen(&self) -> bool {
        self.interval.lower > 0.0
    }
}

/// The noise terms of one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseTerms {
    /// In the order of [`NoiseTerm::ALL`].
    pub estimates: [Estimate; 5],
    /// Relative misfit of `σ²` that the five terms leave beyond their scatter (a filter or a
    /// resonance of the sensor, say); zero where they suffice. The intervals include it.
    pub model_error: f64,
    /// Longest averaging time fitted, s.
    pub longest_tau: f64,
    samples: usize,
    step: f64,
}

impl NoiseTerms {
    /// The estimate of one term.
    pub fn get(&self, term: NoiseTerm) -> &Estimate {
        &self.estimates[term as usize]
    }

    /// The fitted Allan deviation at `tau`.
    pub fn deviation(&self, tau: f64) -> f64 {
        variance(tau, &self.squares()).sqrt()
    }

    /// 95 % confidence interval of one measured point, from the scatter that the terms imply.
    pub fn interval(&self, point: &AllanPoint) -> Interval {
        let theta = self.squares();
        let implied = variance(point.tau, &theta);
        let scatter = PairCovariance::new([point.factor; 2], self.samples, self.step).at(&theta);
        let relative = scatter / (implied * implied);
        let squares = invert(POINT_CONFIDENCE, point.deviation.powi(2), |v| Scatter {
            variance: relative * v * v,
            third: 2.0 * (relative * v * v).powi(2) / v.max(f64::MIN_POSITIVE),
        });
        Interval {
            lower: squares.lower.sqrt(),
            upper: squares.upper.sqrt(),
        }
    }

    fn squares(&self) -> [f64; 5] {
        self.estimates.map(|e| e.value * e.value)
    }
}

/// Fits the five noise terms to the octaves of a curve.
///
/// Generalised least squares of `σ²(τ)` with the full covariance of the overlapping estimates, which
/// depends on the terms and is iterated; squared coefficients are held at or above zero. The
/// intervals do not assume that any term is absent: they come from the fit of all five with either
/// sign, so that two terms that this recording cannot tell apart both have wide ones. An upper end
/// is never below what the recording could have seen (that of an estimate of zero).
///
/// Where the five terms miss the curve by more than it scatters (at the 1 % level), every point gets
/// the relative model error that makes the misfit as large as expected.
///
/// `None` with fewer than six octaves (about 256 samples), or where the signal never changes.
pub fn identify(curve: &AllanCurve) -> Option<NoiseTerms> {
    let mut octaves = Octaves::of(curve)?;
    octaves.fit_model_error();
    let theta = octaves.settle()?;
    let fit = octaves.weighted(&theta)?;
    let theta = fit.nonnegative(None);
    let estimates = NoiseTerm::ALL.map(|term| {
        let k = term as usize;
        let squares = fit.interval(k).unwrap_or(Interval {
            lower: 0.0,
            upper: f64::INFINITY,
        });
        let interval = Interval {
            lower: squares.lower.min(theta[k]).sqrt(),
            upper: squares.upper.max(theta[k]).sqrt(),
        };
        Estimate {
            term,
            value: theta[k].sqrt(),
            interval,
        }
    });
    Some(NoiseTerms {
        estimates,
        model_error: octaves.model_error,
        longest_tau: octaves.points.last()?.tau,
        samples: curve.samples,
        step: curve.step,
    })
}

/// The χ² above which a misfit is no accident.
fn limit(freedom: f64) -> f64 {
    ChiSquared::new(freedom).map_or(f64::INFINITY, |law| law.inverse_cdf(1.0 - MISFIT_LEVEL))
}

/// The points fitted, and how they scatter together.
struct Octaves {
    points: Vec<AllanPoint>,
    covariance: Vec<Vec<PairCovariance>>,
    /// Standard deviation of the model itself, relative to `σ²`.
    model_error: f64,
}

impl Octaves {
    fn of(curve: &AllanCurve) -> Option<Self> {
        let points: Vec<AllanPoint> = curve
            .points
            .iter()
            .filter(|p| p.factor.is_power_of_two() && SPANS * p.factor <= curve.samples)
            .copied()
            .collect();
        let varied = points
            .iter()
            .all(|p| p.deviation > 0.0 && p.deviation.is_finite());
        if points.len() < FEWEST_POINTS || !varied {
            return None;
        }
        let covariance = (0..points.len())
            .map(|i| {
                (0..=i)
                    .map(|j| {
                        let factors = [points[j].factor, points[i].factor];
                        PairCovariance::new(factors, curve.samples, curve.step)
                    })
                    .collect()
            })
            .collect();
        Some(Self {
            points,
            covariance,
            model_error: 0.0,
        })
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
    fn settle(&self) -> Option<[f64; 5]> {
        let mut theta = self.first_guess();
        for _ in 0..ROUNDS {
            theta = self.weighted(&theta)?.nonnegative(None);
        }
        Some(theta)
    }

    /// Finds the smallest model error that explains the misfit.
    fn fit_model_error(&mut self) {
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
        Some((self.weighted(&theta)?.chi2(&theta), self.freedom(&theta)))
    }

    fn freedom(&self, theta: &[f64; 5]) -> f64 {
        let used = theta.iter().filter(|&&t| t > 0.0).count();
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
    fn weighted(&self, theta: &[f64; 5]) -> Option<Weighted<'_>> {
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
struct Weighted<'a> {
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

    /// The best squared coefficients that are not negative, by trying every subset of the terms;
    /// the term `held`, if any, keeps its value.
    fn nonnegative(&self, held: Option<(usize, f64)>) -> [f64; 5] {
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
            let Some(theta) = self
                .solve(&terms, &start)
                .filter(|t| t.iter().all(|&t| t >= 0.0))
            else {
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
    fn interval(&self, k: usize) -> Option<Interval> {
        let estimate = self.solve(&[0, 1, 2, 3, 4], &[0.0; 5])?[k];
        let gram = Cholesky::new(self.design.tr_mul(&self.design))?;
        let mut unit = DVector::zeros(5);
        unit[k] = 1.0;
        let row = &self.design * gram.solve(&unit);
        let weights = self.root.l().transpose().solve_upper_triangular(&row)?;
        let scatter = |value: f64| self.scatter(&weights, &self.nonnegative(Some((k, value))));
        Some(invert(
            1.0 - (1.0 - JOINT_CONFIDENCE) / 5.0,
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
