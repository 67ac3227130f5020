//! A few rows that are brought to triangular form, in memory that is used again.

use crate::linear::triangularise;

/// A matrix, column after column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stack {
    entries: Vec<f64>,
    rows: usize,
    columns: usize,
}

impl Stack {
    /// Makes it `rows × columns`, all zero.
    pub fn clear(&mut self, rows: usize, columns: usize) {
        self.entries.clear();
        self.entries.resize(rows * columns, 0.0);
        (self.rows, self.columns) = (rows, columns);
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Column `k`.
    pub fn column(&self, k: usize) -> &[f64] {
        &self.entries[k * self.rows..(k + 1) * self.rows]
    }

    /// Column `k`.
    pub fn column_mut(&mut self, k: usize) -> &mut [f64] {
        &mut self.entries[k * self.rows..(k + 1) * self.rows]
    }

    /// Replaces it by the `R` of its QR, zeros below the diagonal.
    pub fn triangularise(&mut self) {
        triangularise(&mut self.entries, self.rows);
    }

    /// Appends its first rows to `out`, row after row; zeros where it has fewer.
    pub fn copy_rows(&self, count: usize, out: &mut Vec<f64>) {
        for i in 0..count {
            out.extend((0..self.columns).map(|k| self.column(k).get(i).copied().unwrap_or(0.0)));
        }
    }

    /// Copies what a triangle has below and to the right of its first `n` rows and columns.
    pub fn copy_corner(&self, n: usize, out: &mut Self) {
        let rows = self.rows.min(self.columns).saturating_sub(n);
        out.clear(rows, self.columns - n);
        for k in n..self.columns {
            out.column_mut(k - n)
                .copy_from_slice(&self.column(k)[n..n + rows]);
        }
    }
}
