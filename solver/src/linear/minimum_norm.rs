//! The shortest Gauss–Newton step.

use crate::rules::RANK_TOLERANCE;
use faer::{Mat, MatRef};

/// `argmin ‖p‖` among all `p` that minimise `‖J p + b‖`, by the singular value decomposition of `J`
/// as it stands, in the parameters' own units.
pub(crate) fn minimum_norm(jacobian: MatRef<'_, f64>, b: &[f64]) -> Option<Vec<f64>> {
    let svd = jacobian.thin_svd().ok()?;
    let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
    let rhs = Mat::from_fn(b.len(), 1, |i, _| -b[i]);
    let rotated = u.transpose() * &rhs;
    let largest = s.iter().copied().fold(0.0, f64::max);
    let mut p = vec![0.0; jacobian.ncols()];
    for j in (0..s.nrows()).filter(|&j| s[j] > RANK_TOLERANCE * largest) {
        let coefficient = rotated[(j, 0)] / s[j];
        for (k, value) in p.iter_mut().enumerate() {
            *value += v[(k, j)] * coefficient;
        }
    }
    p.iter().all(|v| v.is_finite()).then_some(p)
}
