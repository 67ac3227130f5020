//! Marginal covariance of some parameters, all others free.

use faer::Mat;
use solver::{Uncertainty, uncertainty};

use crate::methods::joint::blocks::basis::{Basis, RANK_TOLERANCE, orthonormal_with_pivots};
use crate::methods::joint::blocks::columns::Columns;

/// Covariance, rank, condition and unobservable combinations of the columns `keep` of a whitened
/// Jacobian `J` (`m × n`), all others projected out.
///
/// Errors of the rows that the whitening does not know, `carried` (`C`, `m × q`, of unit variance each), add
/// `(J⁺ C)(J⁺ C)ᵀ` to the covariance.
///
/// An error that is the same in all groups of rows and that the whitening takes for another in each, `common` (`u`, `m × g`),
/// adds `a aᵀ − Σ a_g a_gᵀ` with `a_g = J⁺ u_g`, `a` their sum: what the estimates, whose weights are not quite the best,
/// then vary by.
pub fn marginal(
    jacobian: &Columns,
    keep: &[usize],
    names: Vec<String>,
    (carried, common): (&Columns, &Columns),
) -> Uncertainty {
    let others: Vec<usize> = (0..jacobian.ncols())
        .filter(|k| !keep.contains(k))
        .collect();
    let kept = jacobian.select(keep);
    let own = Basis::of(&jacobian.select(&others))
        .without(&kept)
        .to_dense();
    let mut uncertainty = uncertainty(&own, names);
    let n = uncertainty.covariance.len();
    let inverse = Mat::from_fn(n, n, |i, k| uncertainty.covariance[i][k]);
    let spread = |errors: &Columns| &inverse * (own.transpose() * errors.to_dense());
    let mut added = Mat::<f64>::zeros(n, n);
    if carried.ncols() > 0 {
        let by_carried = spread(carried);
        added += &by_carried * by_carried.transpose();
    }
    if common.ncols() > 1 {
        let by_group = spread(common);
        let together = &by_group * Mat::from_fn(common.ncols(), 1, |_, _| 1.0);
        added += &together * together.transpose() - &by_group * by_group.transpose();
    }
    for (i, row) in uncertainty.covariance.iter_mut().enumerate() {
        for (k, entry) in row.iter_mut().enumerate() {
            *entry += added[(i, k)];
        }
    }
    uncertainty
}

/// The columns of the first `shared` parameters less what those of all others can take of them; `free` are the places of the
/// columns among the parameters.
pub fn reduced(jacobian: &Columns, free: &[usize], shared: usize) -> Columns {
    let (own, others): (Vec<usize>, Vec<usize>) = (0..free.len()).partition(|&k| free[k] < shared);
    Basis::of(&jacobian.select(&others)).without(&jacobian.select(&own))
}

/// Some columns of a matrix.
pub fn columns(a: &Mat<f64>, which: &[usize]) -> Mat<f64> {
    Mat::from_fn(a.nrows(), which.len(), |i, k| a[(i, which[k])])
}

/// The part of the columns of `a` that is orthogonal to those of `rest`.
pub fn without(rest: &Mat<f64>, a: &Mat<f64>) -> Mat<f64> {
    let basis = orthonormal(rest);
    a - &basis * (basis.transpose() * a)
}

/// An orthonormal basis of the column space, columns scaled to unit length first.
pub fn orthonormal(a: &Mat<f64>) -> Mat<f64> {
    let norms: Vec<f64> = a.col_iter().map(|c| c.norm_l2()).collect();
    let scaled = Mat::from_fn(a.nrows(), a.ncols(), |i, k| {
        if norms[k] > 0.0 {
            a[(i, k)] / norms[k]
        } else {
            0.0
        }
    });
    orthonormal_with_pivots(&scaled, RANK_TOLERANCE.get(), &mut Vec::new())
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::DenseSolveCore;
    use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
    use faer::{Par, Side};

    use super::*;
    use crate::methods::joint::blocks::groups::RowGroups;

    fn one_group(a: &Mat<f64>) -> Columns {
        Columns::cut(a, &RowGroups::whole(a.nrows()))
    }

    #[test]
    fn the_marginal_covariance_is_the_block_of_the_inverse() {
        let j = Mat::from_fn(9, 4, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0);
        let all = uncertainty(&j, (0..4).map(|k| k.to_string()).collect());
        let (cut, none) = (one_group(&j), one_group(&Mat::zeros(9, 0)));
        let some = marginal(&cut, &[1, 3], vec!["1".into(), "3".into()], (&none, &none));
        for (a, i) in [1, 3].into_iter().enumerate() {
            for (b, k) in [1, 3].into_iter().enumerate() {
                let error = some.covariance[a][b] - all.covariance[i][k];
                assert!(error.abs() < 1e-12 * all.covariance[1][1]);
            }
        }
    }

    #[test]
    fn what_the_weights_do_not_know_adds_what_it_does_to_the_estimates() {
        let j = Mat::from_fn(9, 4, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0);
        // An error of the rows along what a change of 0.5 in parameter 3 and of −2 in parameter 0 does.
        let carried = Mat::from_fn(9, 1, |i, _| 0.5 * j[(i, 3)] - 2.0 * j[(i, 0)]);
        let names = || vec!["1".into(), "3".into()];
        let (j, none) = (one_group(&j), one_group(&Mat::zeros(9, 0)));
        let carried = one_group(&carried);
        let without = marginal(&j, &[1, 3], names(), (&none, &none)).covariance;
        let with = marginal(&j, &[1, 3], names(), (&carried, &none)).covariance;
        assert!((with[0][0] - without[0][0]).abs() < 1e-12);
        assert!((with[1][1] - without[1][1] - 0.25).abs() < 1e-12);
    }

    #[test]
    fn an_error_that_groups_have_in_common_is_that_of_estimates_weighted_as_if_it_were_not() {
        let j = Mat::from_fn(12, 2, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0);
        let groups = RowGroups::new((0..12).map(|i| i / 6).collect());
        let u = Mat::from_fn(12, 2, |i, g| {
            if i / 6 == g {
                0.3 * (i as f64).sin()
            } else {
                0.0
            }
        });
        // White rows with u of each group in their noise, then the same u in both.
        let identity = Mat::<f64>::identity(12, 12);
        let sum = &u * Mat::from_fn(2, 1, |_, _| 1.0);
        let (apart, together) = (
            &identity + &u * u.transpose(),
            identity + &sum * sum.transpose(),
        );
        let lower = apart.llt(Side::Lower).unwrap().L().to_owned();
        let whitened = |a: &Mat<f64>| {
            let mut a = a.clone();
            solve_lower_triangular_in_place(lower.as_ref(), a.as_mut(), Par::Seq);
            a
        };
        let (w, none) = (whitened(&j), Mat::<f64>::zeros(12, 0));
        let [cut, common, none] = [&w, &whitened(&u), &none].map(|a| Columns::cut(a, &groups));
        let names = vec!["0".into(), "1".into()];
        let found = marginal(&cut, &[0, 1], names, (&none, &common)).covariance;
        let inverse = (w.transpose() * &w).llt(Side::Lower).unwrap().inverse();
        let half = whitened(&whitened(&together).transpose().to_owned());
        let exact = &inverse * (w.transpose() * (half * &w)) * &inverse;
        for i in 0..2 {
            for k in 0..2 {
                assert!((found[i][k] - exact[(i, k)]).abs() < 1e-14);
            }
        }
    }
}
