//! Sums of products of a few rows: `A_rᵀ A_c`.

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Simd;

use super::product::add_multiple;
use super::structure::Structure;

/// Places of two blocks of columns in rows of `width`: first column and width of each.
pub(crate) struct Places {
    pub width: usize,
    pub row: (usize, usize),
    pub column: (usize, usize),
}

/// Adds `J_rᵀ J_c` to `out` (`rows × columns`, column after column), or replaces it if `first`.
#[inline(always)]
pub(crate) fn add_outer<S: Simd>(
    simd: S,
    out: &mut [f64],
    first: bool,
    jacobian: &[f64],
    places: &Places,
) {
    match (places.row.1, places.column.1) {
        (2, 2) => fixed::<S, 2, 2>(simd, out, first, jacobian, places),
        (3, 3) => fixed::<S, 3, 3>(simd, out, first, jacobian, places),
        (6, 3) => fixed::<S, 6, 3>(simd, out, first, jacobian, places),
        (6, 6) => fixed::<S, 6, 6>(simd, out, first, jacobian, places),
        (9, 3) => fixed::<S, 9, 3>(simd, out, first, jacobian, places),
        (9, 9) => fixed::<S, 9, 9>(simd, out, first, jacobian, places),
        _ => any(simd, out, first, jacobian, places),
    }
}

/// Like [`add_outer`], of two rows.
#[inline(always)]
pub(crate) fn add_two_rows<S: Simd, const R: usize, const C: usize>(
    simd: S,
    out: &mut [f64],
    first: bool,
    left: [&[f64; R]; 2],
    right: [&[f64; C]; 2],
) {
    let (out, _) = out.as_chunks_mut::<R>();
    let Some(out) = out.first_chunk_mut::<C>() else {
        return;
    };
    match R / S::F64_LANES {
        1 => two_lines::<S, 1, R, C>(simd, out, first, left, right),
        2 => two_lines::<S, 2, R, C>(simd, out, first, left, right),
        4 => two_lines::<S, 4, R, C>(simd, out, first, left, right),
        _ => two_lines::<S, 0, R, C>(simd, out, first, left, right),
    }
}

#[inline(always)]
fn fixed<S: Simd, const R: usize, const C: usize>(
    simd: S,
    out: &mut [f64],
    first: bool,
    jacobian: &[f64],
    places: &Places,
) {
    // The number of vectors is to be known: otherwise they are kept in memory, not in registers.
    match R / S::F64_LANES {
        1 => vectors::<S, 1, R, C>(simd, out, first, jacobian, places),
        2 => vectors::<S, 2, R, C>(simd, out, first, jacobian, places),
        4 => vectors::<S, 4, R, C>(simd, out, first, jacobian, places),
        _ => vectors::<S, 0, R, C>(simd, out, first, jacobian, places),
    }
}

/// Two rows of the Jacobian at a time, of an odd number the last with a row of zeros; `V` vectors
/// are most of a column (0: no vectors).
#[inline(always)]
fn vectors<S: Simd, const V: usize, const R: usize, const C: usize>(
    simd: S,
    out: &mut [f64],
    mut first: bool,
    jacobian: &[f64],
    &Places { width, row, column }: &Places,
) {
    let (out, _) = out.as_chunks_mut::<R>();
    let Some(out) = out.first_chunk_mut::<C>() else {
        return;
    };
    if jacobian.is_empty() && first {
        *out = [[0.0; R]; C];
    }
    let mut lines = jacobian.chunks_exact(width.max(1));
    while let Some(line) = lines.next() {
        let left = line[row.0..].first_chunk::<R>();
        let right = line[column.0..].first_chunk::<C>();
        let (Some(left), Some(right)) = (left, right) else {
            return;
        };
        let (mut lower, mut factors) = (&[0.0; R], &[0.0; C]);
        if let Some(line) = lines.next()
            && let Some(next) = line[row.0..].first_chunk::<R>()
            && let Some(right) = line[column.0..].first_chunk::<C>()
        {
            (lower, factors) = (next, right);
        }
        two_lines::<S, V, R, C>(simd, out, first, [left, lower], [right, factors]);
        first = false;
    }
}

/// The products of two rows, of which `left` and `right` are the parts.
#[inline(always)]
fn two_lines<S: Simd, const V: usize, const R: usize, const C: usize>(
    simd: S,
    out: &mut [[f64; R]; C],
    first: bool,
    left: [&[f64; R]; 2],
    right: [&[f64; C]; 2],
) {
    let (one, _) = S::as_simd_f64s(left[0].as_slice());
    let (two, _) = S::as_simd_f64s(left[1].as_slice());
    let (Some(&one), Some(&two)) = (one.first_chunk::<V>(), two.first_chunk::<V>()) else {
        return;
    };
    for c in 0..C {
        let (a, b) = (right[0][c], right[1][c]);
        let (body, _) = S::as_mut_simd_f64s(out[c].as_mut_slice());
        let Some(body) = body.first_chunk_mut::<V>() else {
            return;
        };
        let (many_a, many_b) = (simd.splat_f64s(a), simd.splat_f64s(b));
        for v in 0..V {
            let known = if first { simd.splat_f64s(0.0) } else { body[v] };
            let sum = simd.mul_add_e_f64s(one[v], many_a, known);
            body[v] = simd.mul_add_e_f64s(two[v], many_b, sum);
        }
        for t in V * S::F64_LANES..R {
            let known = if first { 0.0 } else { out[c][t] };
            out[c][t] = known + left[0][t] * a + left[1][t] * b;
        }
    }
}

/// Adds `J_aᵀ r` to the gradient of one block whose columns begin at `first`.
#[inline(always)]
pub(crate) fn add_gradient(
    gradient: &mut [f64],
    jacobian: &[f64],
    residuals: &[f64],
    width: usize,
    first: usize,
) {
    match gradient.len() {
        2 => gradient_of::<2>(gradient, jacobian, residuals, width, first),
        3 => gradient_of::<3>(gradient, jacobian, residuals, width, first),
        6 => gradient_of::<6>(gradient, jacobian, residuals, width, first),
        9 => gradient_of::<9>(gradient, jacobian, residuals, width, first),
        columns => {
            for (line, r) in jacobian.chunks_exact(width.max(1)).zip(residuals) {
                let own = &line[first..first + columns];
                for c in 0..columns {
                    gradient[c] += own[c] * r;
                }
            }
        }
    }
}

#[inline(always)]
fn gradient_of<const R: usize>(
    gradient: &mut [f64],
    jacobian: &[f64],
    residuals: &[f64],
    width: usize,
    first: usize,
) {
    let Some(gradient) = gradient.first_chunk_mut::<R>() else {
        return;
    };
    for (line, r) in jacobian.chunks_exact(width.max(1)).zip(residuals) {
        let Some(own) = line[first..].first_chunk::<R>() else {
            return;
        };
        for c in 0..R {
            gradient[c] += own[c] * r;
        }
    }
}

/// Like [`fixed`], of any size.
#[inline(always)]
fn any<S: Simd>(
    simd: S,
    out: &mut [f64],
    empty: bool,
    jacobian: &[f64],
    &Places {
        width,
        row: (first, rows),
        column: (column, columns),
    }: &Places,
) {
    if empty {
        out.fill(0.0);
    }
    if width == 0 || rows == 0 {
        return;
    }
    for line in jacobian.chunks_exact(width) {
        let left = &line[first..first + rows];
        let right = &line[column..column + columns];
        for c in 0..columns {
            let own = &mut out[c * rows..(c + 1) * rows];
            add_multiple(simd, own, left, right[c]);
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
    /// True where a block of this shape is wide.
    pub fn takes(&self, rows: usize, columns: usize) -> bool {
        rows * columns >= WIDE && rows.min(columns) >= 8
    }

    /// Adds rows of a block.
    pub fn push(
        &mut self,
        h: &mut [f64],
        structure: &Structure,
        slot: usize,
        jacobian: &[f64],
        &Places { width, row, column }: &Places,
    ) {
        if width == 0 {
            return;
        }
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
        if self.left.is_empty() {
            return;
        }
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
