//! The score (Lagrange multiplier) statistic of columns that the model lacks.

use faer::{Mat, MatRef};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

findings::tuning! {
    /// A direction of the columns whose information is below this share of the largest, or below
    /// [`FAINT`], is not observable.
    UNSEEN: f64 = 1e-9;

    /// Columns are scaled to the typical size of what they stand for: a direction in which ten times that
    /// moves the data by less than a standard deviation is not seen.
    FAINT: f64 = 0.01;
}

/// Score test of some columns against the residuals.
#[derive(Clone, Debug)]
pub struct Score {
    /// `bᵀ A⁺ b`: χ² of `dof` when nothing is missing.
    pub statistic: f64,
    /// Rank of `A`: how many of the columns the data can see.
    pub dof: usize,
    /// `A⁺ b`: how much of the columns the disagreement has. A parameter that has them moves the other way.
    pub change: Vec<f64>,
    /// `A⁺`: its covariance.
    pub covariance: DMatrix<f64>,
    /// `ln det A⁺` over the directions that are seen.
    pub log_determinant: f64,
}

/// Computes the score of whitened columns `w` (`q × k`) against the residuals `z` (`q × 1`): `A = wᵀw`, `b = wᵀz`.
pub fn score(w: MatRef<'_, f64>, z: &Mat<f64>) -> Score {
    let k = w.ncols();
    let gram = w.transpose() * w;
    let moved = w.transpose() * z;
    let a = DMatrix::from_fn(k, k, |i, j| gram[(i, j)]);
    let b = DVector::from_fn(k, |i, _| moved[(i, 0)]);
    of_normal(&a, &b)
}

/// The score by the normal equations.
pub fn of_normal(a: &DMatrix<f64>, b: &DVector<f64>) -> Score {
    let k = b.len();
    let mut result = Score {
        statistic: 0.0,
        dof: 0,
        change: vec![0.0; k],
        covariance: DMatrix::zeros(k, k),
        log_determinant: 0.0,
    };
    if k == 0 || a.iter().chain(b.iter()).any(|v| !v.is_finite()) {
        return result;
    }
    let eigen = a.clone().symmetric_eigen();
    let least = FAINT.get().max(UNSEEN.get() * eigen.eigenvalues.max());
    let mut change = DVector::zeros(k);
    for (value, vector) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        if *value <= least {
            continue;
        }
        let along = vector.dot(b);
        result.statistic += along * along / value;
        result.dof += 1;
        result.log_determinant -= value.ln();
        change += vector * (along / value);
        result.covariance += vector * vector.transpose() / *value;
    }
    result.change = change.iter().copied().collect();
    result
}

/// `ln P(χ²_dof > x)`, exact where the tail is below what a double can hold.
pub fn log_tail(x: f64, dof: f64) -> f64 {
    if dof <= 0.0 || x <= 0.0 {
        return 0.0;
    }
    let p = ChiSquared::new(dof).map_or(1.0, |law| law.sf(x));
    if p > 1e-250 {
        return p.ln();
    }
    // Q(a, y) ≈ y^{a−1} e^{−y} / Γ(a) · y / (y + 1 − a), a = dof/2, y = x/2 (first convergent of Legendre's
    // continued fraction), good to (a/y)².
    let (a, y) = (0.5 * dof, 0.5 * x);
    (a - 1.0) * y.ln() - y - statrs::function::gamma::ln_gamma(a) + (y / (y + 1.0 - a)).ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_statistic_of_independent_columns_is_the_sum_of_squares() {
        let w = Mat::from_fn(5, 2, |i, j| if i == j { 2.0 } else { 0.0 });
        let z = Mat::from_fn(5, 1, |i, _| i as f64 + 1.0);
        let s = score(w.as_ref(), &z);
        assert_eq!(s.dof, 2);
        assert!((s.statistic - 5.0).abs() < 1e-12);
        assert!((s.change[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_column_that_nothing_shows_costs_no_degree_of_freedom() {
        let w = Mat::from_fn(5, 2, |i, j| if i == j && j == 0 { 2.0 } else { 0.0 });
        let z = Mat::from_fn(5, 1, |_, _| 1.0);
        assert_eq!(score(w.as_ref(), &z).dof, 1);
    }

    #[test]
    fn the_far_tail_continues_the_near_one() {
        for dof in [1.0, 3.0, 9.0, 250.0] {
            // Where both are representable: the largest x with P above 1e-250.
            let mut x = 900.0;
            while ChiSquared::new(dof).unwrap().sf(x) < 1e-249 {
                x -= 1.0;
            }
            let exact = log_tail(x, dof);
            let (a, y) = (0.5 * dof, 0.5 * x);
            let far = (a - 1.0) * f64::ln(y) - y - statrs::function::gamma::ln_gamma(a)
                + f64::ln(y / (y + 1.0 - a));
            assert!((far / exact - 1.0).abs() < 1e-3, "{dof}: {far} {exact}");
        }
    }
}
