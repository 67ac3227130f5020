//! What the elimination of one block takes from the others: `S −= Y Yᵀ`, `Y = W L⁻ᵀ`.
//!
//! Everything here is inlined into a function compiled for the vector instructions that the machine
//! has. Written out: left to itself the compiler takes the columns, not the rows, for vectors.

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Simd;

use super::reduced::{Place, Reduced};
use super::structure::Structure;

/// Room for the neighbours of one block, and columns collected for one wide neighbour.
#[derive(Debug, Default)]
pub(crate) struct Update {
    y: Vec<f64>,
    panel: Vec<f64>,
    /// Position and width of the neighbour of the columns.
    wide: Option<(usize, usize)>,
}

/// Width from which a single neighbour's columns are collected for a matrix product.
const WIDE: usize = 16;

/// Columns collected.
const COLUMNS: usize = 96;

/// Takes the products of the neighbours of `e` from what is left, given `L` of `V_e` and
/// `y = L⁻¹ b_e`.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(crate) fn subtract_products<S: Simd>(
    simd: S,
    s: &Structure,
    reduced: &mut Reduced,
    update: &mut Update,
    h: &[f64],
    e: usize,
    l: &[f64],
    y: &[f64],
    left: &mut [f64],
) {
    let d = s.width(e);
    let slots = s.column[e] + 1..s.column[e + 1];
    let from = s.entry[slots.start];
    let all = &h[from..s.entry[slots.end]];
    update.y.clear();
    update.y.extend_from_slice(all);
    for slot in slots.clone() {
        let row = s.row[slot] as usize;
        let rows = s.width(row);
        let y_i = &mut update.y[s.entry[slot] - from..s.entry[slot + 1] - from];
        right_solve(y_i, rows, l, d);
        let out = &mut left[s.first[row] - s.split()..][..rows];
        for (column, y) in y_i.chunks_exact(rows).zip(y) {
            out.iter_mut().zip(column).for_each(|(o, w)| *o -= w * y);
        }
    }
    if slots.len() == 1 && y.len() == d {
        let j = s.row[slots.start] as usize;
        if s.width(j) >= WIDE {
            collect(s, reduced, update, j);
            return;
        }
    }
    for column in slots.clone() {
        let j = s.row[column] as usize;
        let y_j = &update.y[s.entry[column] - from..s.entry[column + 1] - from];
        let reach = Reach { s, j, d };
        for slot in column..slots.end {
            let i = s.row[slot] as usize;
            let y_i = &update.y[s.entry[slot] - from..s.entry[slot + 1] - from];
            reach.subtract(simd, reduced, i, y_i, y_j);
        }
    }
}

/// Keeps the columns of a wide neighbour; a product takes many at once.
fn collect(s: &Structure, reduced: &mut Reduced, update: &mut Update, j: usize) {
    if update.wide.is_some_and(|(other, _)| other != j) {
        flush(s, reduced, update);
    }
    let width = s.width(j);
    update.wide = Some((j, width));
    let (y, panel) = (&update.y, &mut update.panel);
    panel.extend_from_slice(y);
    if update.panel.len() >= COLUMNS * width {
        flush(s, reduced, update);
    }
}

/// Subtracts the products of the columns that were collected.
pub(crate) fn flush(s: &Structure, reduced: &mut Reduced, update: &mut Update) {
    let Some((j, width)) = update.wide.take() else {
        return;
    };
    let position = (j - s.eliminated) as u32;
    let first = s.first[j] - s.split();
    if let Some(place) = reduced.place(position, position, first, width) {
        let end = place.base + (width - 1) * place.stride + width;
        let entries = &mut reduced.entries()[place.base..end];
        let columns = update.panel.len() / width;
        let y = MatRef::from_column_major_slice(&update.panel, width, columns);
        matmul(
            MatMut::from_column_major_slice_with_stride_mut(entries, width, width, place.stride),
            BlockStructure::TriangularLower,
            Accum::Add,
            y,
            BlockStructure::Rectangular,
            y.transpose(),
            BlockStructure::Rectangular,
            -1.0,
            Par::Seq,
        );
    }
    update.panel.clear();
}

/// `W L⁻ᵀ` in place, `W` being `rows × d`, column after column.
#[inline(always)]
fn right_solve(w: &mut [f64], rows: usize, l: &[f64], d: usize) {
    for c in 0..d {
        let (before, own) = w.split_at_mut(c * rows);
        let own = &mut own[..rows];
        for k in 0..c {
            let factor = l[k * d + c];
            let known = &before[k * rows..(k + 1) * rows];
            own.iter_mut()
                .zip(known)
                .for_each(|(o, k)| *o -= k * factor);
        }
        let inverse = 1.0 / l[c * (d + 1)];
        own.iter_mut().for_each(|o| *o *= inverse);
    }
}

/// A column of what is left.
struct Reach<'a> {
    s: &'a Structure,
    j: usize,
    d: usize,
}

impl Reach<'_> {
    /// `S_ij −= Y_i Y_jᵀ`.
    #[inline(always)]
    fn subtract<S: Simd>(
        &self,
        simd: S,
        reduced: &mut Reduced,
        i: usize,
        y_i: &[f64],
        y_j: &[f64],
    ) {
        let (s, j) = (self.s, self.j);
        let (rows, columns) = (s.width(i), s.width(j));
        let place = reduced.place(
            (i - s.eliminated) as u32,
            (j - s.eliminated) as u32,
            s.first[i] - s.split(),
            rows,
        );
        let Some(place) = place else { return };
        let entries = reduced.entries();
        match (rows, self.d) {
            (9, 3) => fixed::<S, 9, 3>(simd, entries, place, columns, y_i, y_j),
            (6, 3) => fixed::<S, 6, 3>(simd, entries, place, columns, y_i, y_j),
            (_, d) => {
                for c in 0..columns {
                    let at = place.base + c * place.stride;
                    let out = &mut entries[at..at + rows];
                    for k in 0..d {
                        let left = &y_i[k * rows..(k + 1) * rows];
                        take(simd, out, left, y_j[k * columns + c]);
                    }
                }
            }
        }
    }
}

/// The products of a block of `R` rows, `E` columns of `Y` at a time.
#[inline(always)]
fn fixed<S: Simd, const R: usize, const E: usize>(
    simd: S,
    entries: &mut [f64],
    place: Place,
    columns: usize,
    y_i: &[f64],
    y_j: &[f64],
) {
    let (left, _) = y_i.as_chunks::<R>();
    let Some(left) = left.first_chunk::<E>() else {
        return;
    };
    for c in 0..columns {
        let at = place.base + c * place.stride;
        let Some(out) = entries[at..].first_chunk_mut::<R>() else {
            return;
        };
        let (body, tail) = S::as_mut_simd_f64s(out.as_mut_slice());
        let mut factors = [0.0; E];
        for k in 0..E {
            factors[k] = -y_j[k * columns + c];
        }
        for v in 0..body.len() {
            let mut sum = body[v];
            for k in 0..E {
                let (own, _) = S::as_simd_f64s(left[k].as_slice());
                sum = simd.mul_add_e_f64s(own[v], simd.splat_f64s(factors[k]), sum);
            }
            body[v] = sum;
        }
        let first = R - tail.len();
        for t in 0..tail.len() {
            let mut sum = tail[t];
            for k in 0..E {
                sum += left[k][first + t] * factors[k];
            }
            tail[t] = sum;
        }
    }
}

/// `out −= left · factor`.
#[inline(always)]
fn take<S: Simd>(simd: S, out: &mut [f64], left: &[f64], factor: f64) {
    let (body, tail) = S::as_mut_simd_f64s(out);
    let (own, rest) = S::as_simd_f64s(left);
    let many = simd.splat_f64s(-factor);
    for (o, l) in body.iter_mut().zip(own) {
        *o = simd.mul_add_e_f64s(*l, many, *o);
    }
    for (o, l) in tail.iter_mut().zip(rest) {
        *o -= l * factor;
    }
}
