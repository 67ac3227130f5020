//! What the elimination of one block takes from the others: `S −= Y Yᵀ`, `Y = W L⁻ᵀ`.
//!
//! Everything here is inlined into a function compiled for the vector instructions that the machine
//! has. Products and sums stay separate roundings, so that the result is the same on every machine.

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};

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
pub(crate) fn subtract_products(
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
            reach.subtract(reduced, i, y_i, y_j);
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
    if let Some(place) = reduced.place(position, position, first, first) {
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
    fn subtract(&self, reduced: &mut Reduced, i: usize, y_i: &[f64], y_j: &[f64]) {
        let (s, j) = (self.s, self.j);
        let place = reduced.place(
            (i - s.eliminated) as u32,
            (j - s.eliminated) as u32,
            s.first[i] - s.split(),
            s.first[j] - s.split(),
        );
        let Some(place) = place else { return };
        let (rows, columns) = (s.width(i), s.width(j));
        let entries = reduced.entries();
        match (rows, self.d) {
            (9, 3) => fixed::<9, 3>(entries, place, columns, y_i, y_j),
            (6, 3) => fixed::<6, 3>(entries, place, columns, y_i, y_j),
            _ => any(entries, place, (rows, columns, self.d), y_i, y_j),
        }
    }
}

#[inline(always)]
fn fixed<const R: usize, const E: usize>(
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
    let last = place.base + columns.saturating_sub(1) * place.stride + R;
    if entries.len() < last || y_j.len() < E * columns {
        return;
    }
    for c in 0..columns {
        let at = place.base + c * place.stride;
        let Some(out) = entries[at..].first_chunk_mut::<R>() else {
            return;
        };
        let mut sum = *out;
        for k in 0..E {
            let factor = y_j[k * columns + c];
            for r in 0..R {
                sum[r] -= left[k][r] * factor;
            }
        }
        *out = sum;
    }
}

#[inline(always)]
fn any(
    entries: &mut [f64],
    place: Place,
    (rows, columns, d): (usize, usize, usize),
    y_i: &[f64],
    y_j: &[f64],
) {
    for c in 0..columns {
        let at = place.base + c * place.stride;
        let out = &mut entries[at..at + rows];
        for k in 0..d {
            let factor = y_j[k * columns + c];
            let left = &y_i[k * rows..(k + 1) * rows];
            out.iter_mut().zip(left).for_each(|(o, l)| *o -= l * factor);
        }
    }
}
