//! Sums of products of a few rows: `A_rᵀ A_c`.

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};

use super::structure::Structure;

/// Adds `J_rᵀ J_c` to `out` (`rows × columns`, column after column); `row` and `column` are first
/// column and width in `J` (row after row, `width` each).
#[inline]
pub(crate) fn add_outer(
    out: &mut [f64],
    jacobian: &[f64],
    width: usize,
    row: (usize, usize),
    column: (usize, usize),
) {
    match row.1 {
        1 => fixed::<1>(out, jacobian, width, row.0, column),
        2 => fixed::<2>(out, jacobian, width, row.0, column),
        3 => fixed::<3>(out, jacobian, width, row.0, column),
        6 => fixed::<6>(out, jacobian, width, row.0, column),
        9 => fixed::<9>(out, jacobian, width, row.0, column),
        _ => any(out, jacobian, width, row, column),
    }
}

#[inline]
fn fixed<const R: usize>(
    out: &mut [f64],
    jacobian: &[f64],
    width: usize,
    first: usize,
    (column, columns): (usize, usize),
) {
    let (out, _) = out.as_chunks_mut::<R>();
    for line in jacobian.chunks_exact(width) {
        let Some(left) = line[first..].first_chunk::<R>() else {
            return;
        };
        for (out, &factor) in out.iter_mut().zip(&line[column..column + columns]) {
            for k in 0..R {
                out[k] += left[k] * factor;
            }
        }
    }
}

fn any(
    out: &mut [f64],
    jacobian: &[f64],
    width: usize,
    (first, rows): (usize, usize),
    (column, columns): (usize, usize),
) {
    for line in jacobian.chunks_exact(width) {
        let left = &line[first..first + rows];
        let right = &line[column..column + columns];
        for (out, factor) in out.chunks_exact_mut(rows).zip(right) {
            for (out, left) in out.iter_mut().zip(left) {
                *out += left * factor;
            }
        }
    }
}

/// Rows for one wide block of `H`, collected until there are enough for a matrix product.
#[derive(Debug, Default)]
pub(crate) struct Panel {
    slot: Option<usize>,
    left: Vec<f64>,
    right: Vec<f64>,
    shape: (usize, usize),
}

/// Entries of a block from which rows are collected.
const WIDE: usize = 400;

/// Rows collected.
const ROWS: usize = 96;

impl Panel {
    /// Whether a block of this shape is wide.
    pub fn takes(&self, rows: usize, columns: usize) -> bool {
        rows * columns >= WIDE && rows.min(columns) >= 8
    }

    /// Adds rows of a block.
    #[allow(clippy::too_many_arguments)]
    pub fn push(
        &mut self,
        h: &mut [f64],
        structure: &Structure,
        slot: usize,
        jacobian: &[f64],
        width: usize,
        row: (usize, usize),
        column: (usize, usize),
    ) {
        if self.slot != Some(slot) {
            self.flush(h, structure);
            self.slot = Some(slot);
            self.shape = (row.1, column.1);
        }
        for line in jacobian.chunks_exact(width) {
            self.left.extend_from_slice(&line[row.0..row.0 + row.1]);
            if row != column {
                self.right
                    .extend_from_slice(&line[column.0..column.0 + column.1]);
            }
        }
        if self.left.len() >= ROWS * row.1 {
            self.flush(h, structure);
            self.slot = Some(slot);
        }
    }

    /// Adds what was collected to the block.
    pub fn flush(&mut self, h: &mut [f64], structure: &Structure) {
        let Some(slot) = self.slot.take() else { return };
        let out = &mut h[structure.entry[slot]..structure.entry[slot + 1]];
        let (rows, columns) = self.shape;
        let lines = self.left.len() / rows.max(1);
        let left = MatRef::from_column_major_slice(&self.left, rows, lines);
        let right = if self.right.is_empty() {
            left
        } else {
            MatRef::from_column_major_slice(&self.right, columns, lines)
        };
        let out = MatMut::from_column_major_slice_mut(out, rows, columns);
        // Of a block on the diagonal the lower triangle alone is read.
        let structure = if self.right.is_empty() {
            BlockStructure::TriangularLower
        } else {
            BlockStructure::Rectangular
        };
        matmul(
            out,
            structure,
            Accum::Add,
            left,
            BlockStructure::Rectangular,
            right.transpose(),
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
        self.left.clear();
        self.right.clear();
    }
}
