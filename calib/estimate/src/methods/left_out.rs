//! Errors of the parameters by an effect that the model leaves out.
//!
//! An effect too small to show moves the estimates of the parameters that it resembles, and neither their standard errors
//! nor the misfit say so. With `R` the whitened columns of the parameters (`m × n`), `E` those of the effect (`m × q`), `r`
//! what the fit leaves, and coefficients of the sizes `D` (diagonal, normal, mean 0) that sensors have,
//!
//! `A = R⁺ E`, `S = Eᵀ (I − R R⁺) E`, `C = (S + D⁻²)⁻¹`, `c = C Eᵀ r`:
//!
//! given the data, the coefficients are `c` with the covariance `C`, and the mean square of the error that leaving them out
//! makes of the parameters is `A (C + c cᵀ) Aᵀ`. That is nothing where the data show that there is no such effect, and
//! `A D² Aᵀ` where they do not see it at all.

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Mat, Side};
use nalgebra::{DMatrix, DVector};

/// The mean square error of each parameter that an effect of the sizes `size` adds if it is left out; `residuals` are those
/// of the fit (`m × 1`), whitened as the columns are.
///
/// `None` where the data do not determine the parameters.
pub fn squares_added(
    parameters: &Mat<f64>,
    effect: &Mat<f64>,
    residuals: &Mat<f64>,
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
    let expected = &covariance * (left.transpose() * residuals);
    let square = covariance + &expected * expected.transpose();
    let errors = &moved * square * moved.transpose();
    Some(
        (0..parameters.ncols())
            .map(|k| errors[(k, k)].max(0.0))
            .collect(),
    )
}

/// The same by a fit that estimates the effect too: `values` and `covariance` are those of the parameters and, last, of the effect.
///
/// With `V` the blocks of that covariance and `e` the effect as found, `A = −V_pe V_ee⁻¹`, `S = V_ee⁻¹`, `c = C S e`.
///
/// `None` where that fit does not determine the effect.
pub fn squares_added_beside(
    values: &[f64],
    covariance: &DMatrix<f64>,
    size: &[f64],
) -> Option<Vec<f64>> {
    let (own, count) = (values.len().checked_sub(size.len())?, size.len());
    let known = covariance.view((own, own), (count, count)).into_owned();
    let known = known.try_inverse()?;
    let moved = covariance.view((0, own), (own, count)) * &known;
    let usual = DVector::from_iterator(count, size.iter().map(|size| size.powi(-2)));
    let given = (&known + DMatrix::from_diagonal(&usual)).try_inverse()?;
    let expected = &given * (&known * DVector::from_column_slice(&values[own..]));
    let square = given + &expected * expected.transpose();
    let errors = &moved * square * moved.transpose();
    Some(errors.diagonal().iter().map(|own| own.max(0.0)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters() -> Mat<f64> {
        Mat::from_fn(9, 3, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0)
    }

    /// Residuals that show nothing.
    fn nothing(m: usize) -> Mat<f64> {
        Mat::zeros(m, 1)
    }

    #[test]
    fn where_nothing_shows_the_square_is_the_variance_of_a_fit_that_estimates_the_effect() {
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
        let added = squares_added(&r, &e, &nothing(9), |k| size[k]).unwrap();
        for (k, added) in added.into_iter().enumerate() {
            let expected = variance(&both, k) - variance(&r, k);
            assert!((added - expected).abs() < 1e-12 * variance(&both, k));
        }
    }

    #[test]
    fn an_effect_that_looks_like_a_parameter_adds_its_own_size() {
        let r = parameters();
        let e = Mat::from_fn(9, 1, |i, _| 4.0 * r[(i, 1)]);
        let added = squares_added(&r, &e, &nothing(9), |_| 0.5).unwrap();
        assert!((added[1] - 4.0).abs() < 1e-9 && added[0].abs() < 1e-9);
    }

    #[test]
    fn an_effect_that_looks_like_no_parameter_adds_nothing() {
        let r = Mat::from_fn(4, 1, |i, _| [1.0, 1.0, 0.0, 0.0][i]);
        let e = Mat::from_fn(4, 1, |i, _| [1.0, -1.0, 5.0, 0.0][i]);
        assert_eq!(
            squares_added(&r, &e, &nothing(4), |_| 1.0).unwrap(),
            vec![0.0]
        );
    }

    #[test]
    fn an_effect_that_shows_adds_the_square_of_what_it_moves() {
        // The effect moves the parameter by its size; of the residual of 20 it leaves the data see (0, 0, 5, 0).
        let r = Mat::from_fn(4, 1, |i, _| [1.0, 1.0, 0.0, 0.0][i]);
        let e = Mat::from_fn(4, 1, |i, _| [1.0, 1.0, 5.0, 0.0][i]);
        let residuals = Mat::from_fn(4, 1, |i, _| [0.0, 0.0, 20.0, 0.0][i]);
        let added = squares_added(&r, &e, &residuals, |_| 1e6).unwrap()[0];
        assert!((added - (4.0 * 4.0 + 1.0 / 25.0)).abs() < 1e-9);
    }

    #[test]
    fn a_fit_that_estimates_the_effect_says_the_same() {
        let (r, size) = (parameters(), [0.3, 2.0]);
        let e = Mat::from_fn(9, 2, |i, k| ((i * 5 + k * 3 + 1) % 7) as f64 - 3.0);
        let y = DVector::from_fn(9, |i, _| ((i * 4 + i * i) % 11) as f64 - 5.0);
        let both = DMatrix::from_fn(9, 5, |i, k| match k.checked_sub(3) {
            Some(k) => e[(i, k)],
            None => r[(i, k)],
        });
        let fit = |columns: &DMatrix<f64>| {
            let covariance = (columns.transpose() * columns).try_inverse().unwrap();
            (&covariance * columns.transpose() * &y, covariance)
        };
        let (values, covariance) = fit(&both);
        let alone = both.columns(0, 3).into_owned();
        let left = &y - &alone * fit(&alone).0;
        let left = Mat::from_fn(9, 1, |i, _| left[i]);
        let expected = squares_added(&r, &e, &left, |k| size[k]).unwrap();
        let found = squares_added_beside(values.as_slice(), &covariance, &size).unwrap();
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        }
    }
}
