//! What the standard errors would be if a sensor had an effect that the model leaves out.
//!
//! An effect too small to show moves the estimates of the parameters that it resembles, and neither their standard errors
//! nor the misfit say so. With `R` the whitened columns of the parameters (`m × n`), `E` those of the effect (`m × q`) and
//! its coefficients of the sizes `D` (diagonal) that sensors have,
//!
//! `A = R⁺ E`, `S = Eᵀ (I − R R⁺) E`, and the covariance of the parameters grows by `A (S + D⁻²)⁻¹ Aᵀ`:
//!
//! by nothing where the data tell the effect from all parameters, by `A D² Aᵀ` where they do not see it at all. That is the
//! covariance of a fit that estimates the coefficients as well and knows them to be of the sizes `D` (normal, mean 0).

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Mat, Side};

/// By how much the variance of each parameter grows if there is an effect of the sizes `size`.
///
/// `None` where the data do not determine the parameters.
pub fn variances_added(
    parameters: &Mat<f64>,
    effect: &Mat<f64>,
    size: impl Fn(usize) -> f64,
) -> Option<Vec<f64>> {
    let count = effect.ncols();
    let normal = (parameters.transpose() * parameters)
        .llt(Side::Lower)
        .ok()?;
    let moved = normal.solve(parameters.transpose() * effect);
    let left = effect - parameters * &moved;
    let mut information = left.transpose() * &left;
    for k in 0..count {
        information[(k, k)] += size(k).powi(-2);
    }
    let covariance = information.llt(Side::Lower).ok()?.inverse();
    let grown = &moved * &covariance;
    let of = |i: usize| (0..count).map(|k| grown[(i, k)] * moved[(i, k)]).sum();
    Some((0..parameters.ncols()).map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters() -> Mat<f64> {
        Mat::from_fn(9, 3, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0)
    }

    #[test]
    fn the_variance_is_that_of_a_fit_that_estimates_the_effect_as_well() {
        let (r, size) = (parameters(), [0.3, 2.0]);
        let e = Mat::from_fn(9, 2, |i, k| ((i * 5 + k * 3 + 1) % 7) as f64 - 3.0);
        // Both, and a row for what is known of each coefficient.
        let both = Mat::from_fn(11, 5, |i, k| match (i.checked_sub(9), k.checked_sub(3)) {
            (None, None) => r[(i, k)],
            (None, Some(c)) => e[(i, c)],
            (Some(row), Some(c)) if row == c => 1.0 / size[c],
            _ => 0.0,
        });
        let variance = |a: &Mat<f64>, k: usize| (a.transpose() * a).full_piv_lu().inverse()[(k, k)];
        let added = variances_added(&r, &e, |k| size[k]).unwrap();
        for (k, added) in added.into_iter().enumerate() {
            let expected = variance(&both, k) - variance(&r, k);
            assert!((added - expected).abs() < 1e-12 * variance(&both, k));
        }
    }

    #[test]
    fn an_effect_that_looks_like_a_parameter_adds_its_own_size() {
        let r = parameters();
        let e = Mat::from_fn(9, 1, |i, _| 4.0 * r[(i, 1)]);
        let added = variances_added(&r, &e, |_| 0.5).unwrap();
        assert!((added[1] - 4.0).abs() < 1e-9 && added[0].abs() < 1e-9);
    }

    #[test]
    fn an_effect_that_looks_like_no_parameter_adds_nothing() {
        let r = Mat::from_fn(4, 1, |i, _| [1.0, 1.0, 0.0, 0.0][i]);
        let e = Mat::from_fn(4, 1, |i, _| [1.0, -1.0, 5.0, 0.0][i]);
        assert_eq!(variances_added(&r, &e, |_| 1.0).unwrap(), vec![0.0]);
    }
}
