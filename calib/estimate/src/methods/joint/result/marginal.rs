//! What the data say of some parameters when all others are free.

use faer::Mat;
use solver::{Uncertainty, uncertainty};

/// Diagonal of a pivoted triangle below this share of its first entry is rank lost.
const RANK_TOLERANCE: f64 = 1e-10;

/// Covariance, rank, condition and unobservable combinations of the columns `keep` of a whitened
/// Jacobian `J` (`m × n`), all others projected out.
///
/// Errors of the rows that the whitening does not know, `carried` (`C`, `m × q`, of unit variance each), add
/// `(J⁺ C)(J⁺ C)ᵀ` to the covariance.
pub fn marginal(
    jacobian: &Mat<f64>,
    keep: &[usize],
    names: Vec<String>,
    carried: &Mat<f64>,
) -> Uncertainty {
    let others: Vec<usize> = (0..jacobian.ncols())
        .filter(|k| !keep.contains(k))
        .collect();
    let kept = columns(jacobian, keep);
    let own = without(&columns(jacobian, &others), &kept);
    let mut uncertainty = uncertainty(&own, names);
    if carried.ncols() > 0 {
        let covariance = &mut uncertainty.covariance;
        let n = covariance.len();
        let inverse = Mat::from_fn(n, n, |i, k| covariance[i][k]);
        let spread = inverse * (own.transpose() * carried);
        let added = &spread * spread.transpose();
        for (i, row) in covariance.iter_mut().enumerate() {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry += added[(i, k)];
            }
        }
    }
    uncertainty
}

/// The columns of the first `shared` parameters less what those of all others can take of them; `free` are the places of the
/// columns among the parameters.
pub fn reduced(jacobian: &Mat<f64>, free: &[usize], shared: usize) -> Mat<f64> {
    let (own, others): (Vec<usize>, Vec<usize>) = (0..free.len()).partition(|&k| free[k] < shared);
    without(&columns(jacobian, &others), &columns(jacobian, &own))
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
    orthonormal_with_volume(a).0
}

/// The same with `½ ln |AᵀA|`, of the part that has rank.
pub(crate) fn orthonormal_with_volume(a: &Mat<f64>) -> (Mat<f64>, f64) {
    let norms: Vec<f64> = a.col_iter().map(|c| c.norm_l2()).collect();
    let scaled = Mat::from_fn(a.nrows(), a.ncols(), |i, k| {
        if norms[k] > 0.0 {
            a[(i, k)] / norms[k]
        } else {
            0.0
        }
    });
    if a.ncols() == 0 {
        return (Mat::zeros(a.nrows(), 0), 0.0);
    }
    let qr = scaled.col_piv_qr();
    let triangle = qr.thin_R();
    let size = triangle.nrows().min(triangle.ncols());
    let first = if size > 0 {
        triangle[(0, 0)].abs()
    } else {
        0.0
    };
    let rank = (0..size)
        .take_while(|&k| triangle[(k, k)].abs() > RANK_TOLERANCE * first)
        .count();
    let pivots = (0..rank).map(|k| triangle[(k, k)].abs());
    let lengths = norms.iter().copied().filter(|norm| *norm > 0.0);
    let log_volume = pivots.chain(lengths).map(f64::ln).sum();
    let basis = qr.compute_thin_Q().as_ref().subcols(0, rank).to_owned();
    (basis, log_volume)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_marginal_covariance_is_the_block_of_the_inverse() {
        let j = Mat::from_fn(9, 4, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0);
        let all = uncertainty(&j, (0..4).map(|k| k.to_string()).collect());
        let some = marginal(&j, &[1, 3], vec!["1".into(), "3".into()], &Mat::zeros(9, 0));
        for (a, i) in [1, 3].into_iter().enumerate() {
            for (b, k) in [1, 3].into_iter().enumerate() {
                let error = some.covariance[a][b] - all.covariance[i][k];
                assert!(error.abs() < 1e-12 * all.covariance[1][1]);
            }
        }
    }

    #[test]
    fn the_volume_is_that_of_the_normal_equations_and_lost_rank_leaves_it_finite() {
        let j = Mat::from_fn(9, 3, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0);
        let half = 0.5 * (j.transpose() * &j).determinant().ln();
        assert!((orthonormal_with_volume(&j).1 - half).abs() < 1e-12);
        let twice = Mat::from_fn(9, 4, |i, k| j[(i, k % 3)]);
        let (basis, volume) = orthonormal_with_volume(&twice);
        let length = j.col(0).norm_l2().ln();
        assert_eq!(basis.ncols(), 3);
        assert!((volume - half - length).abs() < 1e-12);
    }

    #[test]
    fn what_the_weights_do_not_know_adds_what_it_does_to_the_estimates() {
        let j = Mat::from_fn(9, 4, |i, k| ((i * 7 + k * 4 + i * k) % 13) as f64 - 6.0);
        // An error of the rows along what a change of 0.5 in parameter 3 and of −2 in parameter 0 does.
        let carried = Mat::from_fn(9, 1, |i, _| 0.5 * j[(i, 3)] - 2.0 * j[(i, 0)]);
        let names = || vec!["1".into(), "3".into()];
        let without = marginal(&j, &[1, 3], names(), &Mat::zeros(9, 0)).covariance;
        let with = marginal(&j, &[1, 3], names(), &carried).covariance;
        assert!((with[0][0] - without[0][0]).abs() < 1e-12);
        assert!((with[1][1] - without[1][1] - 0.25).abs() < 1e-12);
    }
}
