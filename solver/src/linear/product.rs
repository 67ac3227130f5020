//! Products of a matrix with a vector, on slices.

use faer::{Mat, MatRef};

use super::vector::{add_to, dot};

/// `A p`.
pub(crate) fn multiply(a: MatRef<'_, f64>, p: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; a.nrows()];
    for (column, &factor) in a.col_iter().zip(p).filter(|(_, p)| **p != 0.0) {
        match column.try_as_col_major() {
            Some(column) => add_to(&mut out, factor, column.as_slice()),
            None => {
                for (sum, value) in out.iter_mut().zip(column.iter()) {
                    *sum += factor * value;
                }
            }
        }
    }
    out
}

/// `Aᵀ b`.
pub(crate) fn transpose_multiply(a: MatRef<'_, f64>, b: &[f64]) -> Vec<f64> {
    a.col_iter()
        .map(|column| match column.try_as_col_major() {
            Some(column) => dot(column.as_slice(), b),
            None => column.iter().zip(b).map(|(a, b)| a * b).sum(),
        })
        .collect()
}

/// Row and column of the first entry that is not finite, column by column.
pub(super) fn not_finite(a: &Mat<f64>) -> Option<(usize, usize)> {
    (0..a.ncols()).find_map(|k| {
        let row = a.col_as_slice(k).iter().position(|v| !v.is_finite())?;
        Some((row, k))
    })
}
