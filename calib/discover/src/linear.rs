//! A linear least-squares problem whose columns may be dependent.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// Share of a column's square that is added to it: what no row sees stays at zero.
const RIDGE: f64 = 1e-12;

/// `c` (`n × k`) with the least `‖A c − b‖²`, `A` (`m × n`), `b` (`m × k`), by the normal equations of columns of
/// unit length; `None` where a number is not finite.
pub fn least_squares(a: &Mat<f64>, b: &Mat<f64>) -> Option<Mat<f64>> {
    let norms: Vec<f64> = a
        .col_iter()
        .map(|c| c.norm_l2())
        .map(|norm| if norm > 0.0 { norm } else { 1.0 })
        .collect();
    let scaled = Mat::from_fn(a.nrows(), a.ncols(), |i, k| a[(i, k)] / norms[k]);
    let mut normal = scaled.transpose() * &scaled;
    for k in 0..a.ncols() {
        normal[(k, k)] += RIDGE;
    }
    let solution = normal.llt(Side::Lower).ok()?.solve(scaled.transpose() * b);
    Some(Mat::from_fn(a.ncols(), b.ncols(), |i, k| {
        solution[(i, k)] / norms[i]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_through_three_points_and_a_column_that_nothing_shows() {
        // y = 2 + 3 t at t = 0, 1, 2, one percent of the size of the other column, and a column of zeros.
        let a = Mat::from_fn(3, 3, |i, k| [1.0, 0.01 * i as f64, 0.0][k]);
        let b = Mat::from_fn(3, 1, |i, _| 2.0 + 3.0 * i as f64);
        let c = least_squares(&a, &b).unwrap();
        for (k, value) in [2.0, 300.0, 0.0].into_iter().enumerate() {
            // The ridge is worth 1e-12 of a condition of ten.
            assert!((c[(k, 0)] - value).abs() < 1e-8, "{c:?}");
        }
    }
}
