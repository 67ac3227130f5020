//! A few rows that are brought to triangular form, in memory that is used again.

use std::ops::Range;

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

    /// Replaces it by the `R` of its QR in echelon form; `pivots` become the columns in which its
    /// rows begin. A column of which no more than its floor is left begins none.
    pub fn triangularise(&mut self, floors: &[f64], pivots: &mut Vec<usize>) {
        triangularise(&mut self.entries, self.rows, floors, pivots);
    }

    /// Appends its first rows to `out`, row after row.
    pub fn copy_rows(&self, count: usize, out: &mut Vec<f64>) {
        for i in 0..count {
            out.extend((0..self.columns).map(|k| self.column(k)[i]));
        }
    }

    /// Copies the given rows of the columns from `first` on.
    pub fn copy_corner(&self, rows: Range<usize>, first: usize, out: &mut Self) {
        out.clear(rows.len(), self.columns - first);
        for k in first..self.columns {
            out.column_mut(k - first)
                .copy_from_slice(&self.column(k)[rows.clone()]);
        }
    }
}
