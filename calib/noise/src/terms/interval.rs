//! Confidence intervals of noise terms.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

/// Bisections on the logarithm of the bound.
const BISECTIONS: usize = 60;

/// A confidence interval. `upper` is infinite where the recording is too
/// short to bound the term.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Lower end; zero where the data do not need the term.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl Interval {
    /// Returns true if `value` lies inside.
    pub fn holds(&self, value: f64) -> bool {
        self.lower <= value && value <= self.upper
    }
}

/// Moments of an estimate for a given true value `θ`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scatter {
    /// Variance.
    pub variance: f64,
    /// Third central moment.
    pub third: f64,
}

/// The values `θ ≥ 0` that an estimate does not contradict, with the given confidence.
///
/// A sum of few squares is skewed: its quantiles are taken from the Pearson III (shifted gamma)
/// distribution with the same three moments.
///
/// An estimate far below zero contradicts every `θ ≥ 0`, and the plain upper end would collapse to zero
/// just where the scatter is least understood. The upper end is therefore never below that of an
/// estimate of zero, which is what the recording could have seen at best; that can only add confidence.
pub(crate) fn invert(confidence: f64, estimate: f64, scatter: impl Fn(f64) -> Scatter) -> Interval {
    let tail = 0.5 * (1.0 - confidence);
    let excess = |estimate: f64, theta: f64, probability: f64| {
        let Scatter { variance, third } = scatter(theta);
        let sigma = variance.max(f64::MIN_POSITIVE).sqrt();
        (estimate - theta) / sigma - quantile(probability, third / sigma.powi(3))
    };
    let start = estimate
        .abs()
        .max(scatter(0.0).variance.sqrt())
        .max(f64::MIN_POSITIVE);
    let lower = if excess(estimate, 0.0, 1.0 - tail) <= 0.0 {
        0.0
    } else {
        crossing(0.0, start, |theta| {
            excess(estimate, theta, 1.0 - tail) <= 0.0
        })
    };
    let possible = estimate.max(0.0);
    let upper = crossing(lower, start, |theta| excess(possible, theta, tail) < 0.0);
    Interval { lower, upper }
}

/// Quantile of the Pearson III distribution with mean 0, variance 1 and the given skewness.
fn quantile(probability: f64, skew: f64) -> f64 {
    if skew < 0.0 {
        return -quantile(1.0 - probability, -skew);
    }
    let freedom = 8.0 / (skew * skew);
    let normal = Normal::standard().inverse_cdf(probability);
    // Above a thousand degrees of freedom the first correction to the normal is exact to 1e-3.
    if freedom > 1e3 || freedom.is_nan() {
        return normal + skew * (normal * normal - 1.0) / 6.0;
    }
    match ChiSquared::new(freedom) {
        Ok(chi2) => (chi2.inverse_cdf(probability) - freedom) / (2.0 * freedom).sqrt(),
        Err(_) => normal,
    }
}

/// The first `θ` above `from` from which on `beyond` holds; infinite where it never does.
fn crossing(from: f64, start: f64, beyond: impl Fn(f64) -> bool) -> f64 {
    let mut high = start.max(from);
    let mut low = from;
    for _ in 0..BISECTIONS {
        if beyond(high) {
            break;
        }
        low = high;
        high *= 4.0;
    }
    if !beyond(high) {
        return f64::INFINITY;
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if beyond(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIXED: Scatter = Scatter {
        variance: 1.0,
        third: 0.0,
    };

    /// With nothing but its own scatter, `θ χ²_ν/ν`, the interval is the textbook one,
    /// `ν θ̂ / χ²_{0.975}` to `ν θ̂ / χ²_{0.025}`; χ²₁₀ has 3.24697 and 20.4832 there.
    #[test]
    fn a_pure_sum_of_ten_squares_has_the_chi_square_interval() {
        let interval = invert(0.95, 3.0, |theta| Scatter {
            variance: 2.0 * theta.powi(2) / 10.0,
            third: 8.0 * theta.powi(3) / 100.0,
        });
        assert!(
            (interval.lower - 30.0 / 20.4832).abs() < 1e-4,
            "{interval:?}"
        );
        assert!(
            (interval.upper - 30.0 / 3.24697).abs() < 1e-3,
            "{interval:?}"
        );
    }

    #[test]
    fn a_fixed_error_gives_the_normal_interval() {
        let interval = invert(0.95, 3.0, |_| FIXED);
        assert!((interval.lower - (3.0 - 1.959_964)).abs() < 1e-5);
        assert!((interval.upper - (3.0 + 1.959_964)).abs() < 1e-5);
    }

    #[test]
    fn an_estimate_within_its_error_of_zero_is_only_bounded_above() {
        let interval = invert(0.95, -0.5, |_| FIXED);
        assert_eq!(interval.lower, 0.0);
        assert!((interval.upper - 1.959_964).abs() < 1e-5);
    }

    #[test]
    fn an_estimate_that_contradicts_every_value_is_bounded_by_what_could_have_been_seen() {
        for estimate in [-1.0, -3.0, -1e3] {
            let interval = invert(0.95, estimate, |_| FIXED);
            assert_eq!(interval.lower, 0.0);
            assert!((interval.upper - 1.959_964).abs() < 1e-5, "{interval:?}");
        }
    }
}
