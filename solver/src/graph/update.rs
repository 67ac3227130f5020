//! What the elimination of one block takes from the others: `S −= Y Yᵀ`, `Y = W L⁻ᵀ`.

use super::reduced::{Place, Reduced};
use super::structure::Structure;

/// Room for the neighbours of one block.
#[derive(Debug, Default)]
pub(crate) struct Update {
    y: Vec<f64>,
}

/// Takes the products of the neighbours of `e` from what is left, given `L` of `V_e` and
/// `y = L⁻¹ b_e`.
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
    let base = s.eliminated;
    for column in slots.clone() {
        let j = s.row[column] as usize;
        let columns = s.width(j);
        let y_j = &update.y[s.entry[column] - from..s.entry[column + 1] - from];
        for slot in column..slots.end {
            let i = s.row[slot] as usize;
            let place = reduced.place(
                (i - base) as u32,
                (j - base) as u32,
                s.first[i] - s.split(),
                s.first[j] - s.split(),
            );
            let Some(place) = place else { continue };
            let y_i = &update.y[s.entry[slot] - from..s.entry[slot + 1] - from];
            subtract(reduced.entries(), place, (s.width(i), columns, d), y_i, y_j);
        }
    }
}

/// `W L⁻ᵀ` in place, `W` being `rows × d`, column after column.
#[inline]
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

/// `S_ij −= Y_i Y_jᵀ`.
#[inline]
fn subtract(
    entries: &mut [f64],
    place: Place,
    (rows, columns, d): (usize, usize, usize),
    y_i: &[f64],
    y_j: &[f64],
) {
    match (rows, d) {
        (9, 3) => fixed::<9, 3>(entries, place, columns, y_i, y_j),
        (6, 3) => fixed::<6, 3>(entries, place, columns, y_i, y_j),
        _ => any(entries, place, (rows, columns, d), y_i, y_j),
    }
}

#[inline]
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
