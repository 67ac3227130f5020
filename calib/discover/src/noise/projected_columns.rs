//! Whitened columns that most recordings have nothing of.

use std::ops::Range;

use estimate::methods::joint::Columns;
use faer::Mat;
use nalgebra::{DMatrix, DVector};

/// `P L⁻¹ F` (`q × k`) without its zeros: what recordings share reaches all of them, and is kept apart.
#[derive(Clone, Debug)]
pub struct ProjectedColumns {
    /// `L⁻¹ F`.
    pub inside: Columns,
    /// Projection `Tᵀ L⁻¹ F` (`s × k`) onto the basis `T` of the recordings' shared parameters: `P = I − T Tᵀ`.
    pub taken: Mat<f64>,
}

impl ProjectedColumns {
    /// `A = WᵀW` (`n × n`) and `b = Wᵀz` (`n`) of some of its columns `W`, `z` (`q × 1`) without what is shared.
    pub fn normal(&self, columns: Range<usize>, z: &Mat<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let (first, n) = (columns.start, columns.len());
        let (mut a, mut b) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for part in self.inside.parts() {
            // They are in ascending order.
            let from = part.columns.partition_point(|&k| k < first);
            let to = part.columns.partition_point(|&k| k < columns.end);
            if from == to || part.rows.is_empty() {
                continue;
            }
            let own = part.values.as_ref().subcols(from, to - from);
            let z = z.as_ref().subrows(part.rows[0], part.rows.len());
            let (gram, moved) = (own.transpose() * own, own.transpose() * z);
            let place = |k: usize| part.columns[from + k] - first;
            for i in 0..to - from {
                b[place(i)] += moved[(i, 0)];
                for k in 0..to - from {
                    a[(place(i), place(k))] += gram[(i, k)];
                }
            }
        }
        if self.taken.nrows() > 0 {
            let taken = self.taken.as_ref().subcols(first, n);
            let taken = taken.transpose() * taken;
            for k in 0..n {
                for i in 0..n {
                    a[(i, k)] -= taken[(i, k)];
                }
            }
        }
        (a, b)
    }
}
