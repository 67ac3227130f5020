//! Upper trapezoids.

use faer::Mat;

/// `R` (`rows × n`, `rows ≤ n`) with zeros below the diagonal, row after row.
#[derive(Clone, Debug)]
pub(crate) struct Triangle {
    entries: Vec<f64>,
    columns: usize,
}

impl Triangle {
    /// `entry(i, k)` on and above the diagonal.
    pub fn from_fn(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut entries = vec![0.0; rows * columns];
        for (i, row) in entries.chunks_exact_mut(columns.max(1)).enumerate() {
            for (k, value) in row.iter_mut().enumerate().skip(i) {
                *value = entry(i, k);
            }
        }
        Self { entries, columns }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.entries.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// All entries, row after row.
    pub fn entries(&self) -> &[f64] {
        &self.entries
    }

    /// Row `i` (`n`).
    pub fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.columns..(i + 1) * self.columns]
    }

    /// `R[i, i]`.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.entries[i * self.columns + i]
    }

    /// The triangle as a matrix.
    pub fn to_mat(&self) -> Mat<f64> {
        Mat::from_fn(self.rows(), self.columns, |i, k| self.row(i)[k])
    }
}
