//! `S_ij += Y_i Y_jᵀ` for one block: what takes most of the time of a bundle adjustment.
//!
//! Everything here is inlined into a function compiled for the vector instructions that the machine
//! has. Written out: left to itself the compiler takes the columns, not the rows, for vectors, and
//! what is called over a closure loses the instructions.

use pulp::Simd;

use super::blocks::body;

/// Adds `Y_i Y_jᵀ` to a block laid out as [`body`] says; `Y` are `rows × d` and `columns × d`, column
/// after column.
#[inline(always)]
pub(super) fn add_product<S: Simd>(
    simd: S,
    block: &mut [f64],
    (rows, columns, d): (usize, usize, usize),
    y_i: &[f64],
    y_j: &[f64],
) {
    match (rows, columns, d) {
        (2, 2, 2) => fixed::<S, 2, 2, 2, 2>(simd, block, y_i, y_j),
        (9, 9, 3) => fixed::<S, 9, 8, 9, 3>(simd, block, y_i, y_j),
        (6, 6, 3) => fixed::<S, 6, 4, 6, 3>(simd, block, y_i, y_j),
        (7, 7, 3) => fixed::<S, 7, 4, 7, 3>(simd, block, y_i, y_j),
        _ => any(simd, block, (rows, columns, d), y_i, y_j),
    }
}

/// `R × C` with `E` columns of `Y`; the first `B` rows are stored column after column.
#[inline(always)]
fn fixed<S: Simd, const R: usize, const B: usize, const C: usize, const E: usize>(
    simd: S,
    block: &mut [f64],
    y_i: &[f64],
    y_j: &[f64],
) {
    let (left, _) = y_i.as_chunks::<R>();
    let (right, _) = y_j.as_chunks::<C>();
    let (Some(left), Some(right)) = (left.first_chunk::<E>(), right.first_chunk::<E>()) else {
        return;
    };
    let (upper, lower) = block.split_at_mut(B * C);
    let (upper, _) = upper.as_chunks_mut::<B>();
    let Some(upper) = upper.first_chunk_mut::<C>() else {
        return;
    };
    // The number of vectors is to be known: otherwise they are kept in memory, not in registers.
    match B / S::F64_LANES {
        1 => columns::<S, 1, R, B, C, E>(simd, upper, left, right),
        2 => columns::<S, 2, R, B, C, E>(simd, upper, left, right),
        4 => columns::<S, 4, R, B, C, E>(simd, upper, left, right),
        _ => columns::<S, 0, R, B, C, E>(simd, upper, left, right),
    }
    let (lower, _) = lower.as_chunks_mut::<C>();
    for (r, row) in lower.iter_mut().enumerate().take(R - B) {
        let mut factors = [0.0; E];
        for k in 0..E {
            factors[k] = left[k][B + r];
        }
        match C / S::F64_LANES {
            1 => combine::<S, 1, C, E>(simd, row, right, factors),
            2 => combine::<S, 2, C, E>(simd, row, right, factors),
            4 => combine::<S, 4, C, E>(simd, row, right, factors),
            _ => combine::<S, 0, C, E>(simd, row, right, factors),
        }
    }
}

/// The first `B` rows, of which `V` vectors are a column (0: no vectors).
#[inline(always)]
fn columns<
    S: Simd,
    const V: usize,
    const R: usize,
    const B: usize,
    const C: usize,
    const E: usize,
>(
    simd: S,
    upper: &mut [[f64; B]; C],
    left: &[[f64; R]; E],
    right: &[[f64; C]; E],
) {
    let mut own = [[simd.splat_f64s(0.0); V]; E];
    for k in 0..E {
        let (vectors, _) = S::as_simd_f64s(left[k].as_slice());
        let Some(vectors) = vectors.first_chunk::<V>() else {
            return;
        };
        own[k] = *vectors;
    }
    for c in 0..C {
        let (out, _) = S::as_mut_simd_f64s(upper[c].as_mut_slice());
        let Some(out) = out.first_chunk_mut::<V>() else {
            return;
        };
        let mut sum = *out;
        for k in 0..E {
            let factor = simd.splat_f64s(right[k][c]);
            for v in 0..V {
                sum[v] = simd.mul_add_e_f64s(own[k][v], factor, sum[v]);
            }
        }
        *out = sum;
        for t in V * S::F64_LANES..B {
            for k in 0..E {
                upper[c][t] += left[k][t] * right[k][c];
            }
        }
    }
}

/// `row += Σ vector · factor`, of which `V` vectors are the most.
#[inline(always)]
fn combine<S: Simd, const V: usize, const C: usize, const E: usize>(
    simd: S,
    row: &mut [f64; C],
    vectors: &[[f64; C]; E],
    factors: [f64; E],
) {
    let (out, _) = S::as_mut_simd_f64s(row.as_mut_slice());
    let Some(out) = out.first_chunk_mut::<V>() else {
        return;
    };
    let mut sum = *out;
    for k in 0..E {
        let (own, _) = S::as_simd_f64s(vectors[k].as_slice());
        let Some(own) = own.first_chunk::<V>() else {
            return;
        };
        let factor = simd.splat_f64s(factors[k]);
        for v in 0..V {
            sum[v] = simd.mul_add_e_f64s(own[v], factor, sum[v]);
        }
    }
    *out = sum;
    for t in V * S::F64_LANES..C {
        for k in 0..E {
            row[t] += vectors[k][t] * factors[k];
        }
    }
}

#[inline(always)]
fn any<S: Simd>(
    simd: S,
    block: &mut [f64],
    (rows, columns, d): (usize, usize, usize),
    y_i: &[f64],
    y_j: &[f64],
) {
    let body = body(rows);
    let (upper, lower) = block.split_at_mut(body * columns);
    for k in 0..d {
        let left = &y_i[k * rows..(k + 1) * rows];
        let right = &y_j[k * columns..(k + 1) * columns];
        for (c, factor) in right.iter().enumerate() {
            let out = &mut upper[c * body..(c + 1) * body];
            add_multiple(simd, out, &left[..body], *factor);
        }
        for (r, factor) in left[body..].iter().enumerate() {
            let out = &mut lower[r * columns..(r + 1) * columns];
            add_multiple(simd, out, right, *factor);
        }
    }
}

/// `out += vector · factor`. By places: an iterator over both, where it is not inlined, is a call
/// for every number.
#[inline(always)]
pub(super) fn add_multiple<S: Simd>(simd: S, out: &mut [f64], vector: &[f64], factor: f64) {
    let vector = &vector[..out.len()];
    let (out, rest) = S::as_mut_simd_f64s(out);
    let (own, end) = S::as_simd_f64s(vector);
    let many = simd.splat_f64s(factor);
    for v in 0..out.len() {
        out[v] = simd.mul_add_e_f64s(own[v], many, out[v]);
    }
    for t in 0..rest.len() {
        rest[t] += end[t] * factor;
    }
}
