//! Singular values and right vectors of a small matrix.

use faer::{Mat, MatRef};

use crate::vector::dot;

/// Cosine between two columns at which they count as orthogonal.
const ORTHOGONAL: f64 = 2.0 * f64::EPSILON;

/// Length of a column, relative to the whole matrix, below which it is rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Most sweeps over all pairs; six are usual.
const SWEEPS: usize = 40;

/// Singular values, descending, with the right vectors as the columns of `V` (`n × n`).
pub(crate) struct Singular {
    /// As many as columns; zeros where the matrix has fewer rows.
    pub values: Vec<f64>,
    /// Orthonormal.
    pub vectors: Mat<f64>,
}

/// Rotates pairs of columns until all are orthogonal: their lengths are the singular values, the
/// product of the rotations holds the right vectors. `None` where that does not come to an end
/// (entries that are not finite).
///
/// Source: Hestenes, "Inversion of matrices by biorthogonalization and related results", 1958.
pub(crate) fn singular(a: MatRef<'_, f64>) -> Option<Singular> {
    let n = a.ncols();
    let mut columns: Vec<Vec<f64>> = (0..n).map(|k| a.col(k).iter().copied().collect()).collect();
    let unit = |k: usize| (0..n).map(|i| f64::from(u8::from(i == k))).collect();
    let mut vectors: Vec<Vec<f64>> = (0..n).map(unit).collect();
    let whole: f64 = columns.iter().map(|c| dot(c, c)).sum();
    let floor = ROUNDING * ROUNDING * whole;
    for _ in 0..SWEEPS {
        if !sweep(&mut columns, &mut vectors, floor) {
            return sorted(&columns, &vectors);
        }
    }
    None
}

/// Visits every pair once; whether one had to be rotated.
fn sweep(columns: &mut [Vec<f64>], vectors: &mut [Vec<f64>], floor: f64) -> bool {
    let mut rotated = false;
    for k in 1..columns.len() {
        let (before, after) = columns.split_at_mut(k);
        let (vectors_before, vectors_after) = vectors.split_at_mut(k);
        for (a, v) in before.iter_mut().zip(vectors_before) {
            if let Some(tangent) = tangent(a, &after[0], floor) {
                rotate(tangent, a, &mut after[0]);
                rotate(tangent, v, &mut vectors_after[0]);
                rotated = true;
            }
        }
    }
    rotated
}

/// The tangent of the rotation that makes two columns orthogonal; `None` where they are, or where the
/// square of one is below `floor`.
fn tangent(a: &[f64], b: &[f64], floor: f64) -> Option<f64> {
    let (aa, bb, ab) = (dot(a, a), dot(b, b), dot(a, b));
    if aa.min(bb) <= floor || ab.abs() <= ORTHOGONAL * aa.sqrt() * bb.sqrt() {
        return None;
    }
    let half = (bb - aa) / (2.0 * ab);
    Some(1f64.copysign(half) / (half.abs() + half.hypot(1.0)))
}

fn rotate(tangent: f64, a: &mut [f64], b: &mut [f64]) {
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = cosine * tangent;
    for (a, b) in a.iter_mut().zip(b) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}

fn sorted(columns: &[Vec<f64>], vectors: &[Vec<f64>]) -> Option<Singular> {
    let lengths: Vec<f64> = columns.iter().map(|c| dot(c, c).sqrt()).collect();
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    order.sort_by(|&i, &k| lengths[k].total_cmp(&lengths[i]));
    lengths.iter().all(|v| v.is_finite()).then(|| Singular {
        values: order.iter().map(|&k| lengths[k]).collect(),
        vectors: Mat::from_fn(order.len(), order.len(), |i, k| vectors[order[k]][i]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_decomposition_of_faer() {
        for (m, n) in [(1, 1), (9, 9), (4, 3), (2, 5), (20, 6)] {
            let a = Mat::from_fn(m, n, |i, k| ((i * 5 + k * 3 + i * i * k) % 11) as f64 - 4.0);
            let ours = singular(a.as_ref()).unwrap();
            let full = a.singular_values().unwrap();
            for (k, value) in ours.values.iter().enumerate() {
                let oracle = full.get(k).copied().unwrap_or(0.0);
                assert!((value - oracle).abs() < 1e-13 * full[0], "{m} {n} {k}");
            }
            // `A V` has orthogonal columns of the lengths of the singular values.
            let v = &ours.vectors;
            let gram = v.transpose() * a.transpose() * &a * v;
            let identity = v.transpose() * v;
            for i in 0..n {
                for k in 0..n {
                    let (square, one) = match i == k {
                        true => (ours.values[k].powi(2), 1.0),
                        false => (0.0, 0.0),
                    };
                    assert!((gram[(i, k)] - square).abs() < 1e-12 * full[0] * full[0]);
                    assert!((identity[(i, k)] - one).abs() < 1e-14, "{m} {n} {i} {k}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_finite_has_no_singular_values() {
        assert!(singular(Mat::from_fn(2, 2, |i, _| f64::NAN + i as f64).as_ref()).is_none());
    }
}
