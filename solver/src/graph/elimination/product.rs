//! `S_ij += Σ Y_i Y_jᵀ` for one block: what takes most of the time of a bundle adjustment.
//!
//! Everything here is inlined into a function compiled for the vector instructions that the machine
//! has. Written out: left to itself the compiler takes the columns, not the rows, for vectors, and
//! what is called over a closure loses the instructions.

use pulp::Simd;

use super::blocks::body;
use super::neighbours::Pairs;

/// Adds `Σ Y_i Y_jᵀ` to a block laid out as [`body`] says; `Y` are `rows × d` and `columns × d`, column
/// after column.
#[inline(always)]
pub(crate) fn add_products<S: Simd>(
    simd: S,
    block: &mut [f64],
    (rows, columns, d): (usize, usize, usize),
    y: &[f64],
    pairs: Pairs<'_>,
) {
    let vectors = body(rows) / S::F64_LANES;
    match (rows, columns, d, vectors) {
        (9, 9, 3, 2) => fixed::<S, 2, 2, 4, 5, 9, 8, 9, 3>(simd, block, y, pairs),
        (9, 9, 3, 4) => fixed::<S, 4, 4, 4, 5, 9, 8, 9, 3>(simd, block, y, pairs),
        // Beside cameras of which one number, or attitude and place, are held.
        (9, 8, 3, 2) => fixed::<S, 2, 2, 4, 4, 9, 8, 8, 3>(simd, block, y, pairs),
        (9, 3, 3, 2) => fixed::<S, 2, 0, 3, 0, 9, 8, 3, 3>(simd, block, y, pairs),
        (6, 6, 3, 1) => fixed::<S, 1, 1, 6, 0, 6, 4, 6, 3>(simd, block, y, pairs),
        (6, 6, 3, 2) => fixed::<S, 2, 3, 6, 0, 6, 4, 6, 3>(simd, block, y, pairs),
        (7, 7, 3, 1) => fixed::<S, 1, 1, 7, 0, 7, 4, 7, 3>(simd, block, y, pairs),
        (7, 7, 3, 2) => fixed::<S, 2, 3, 7, 0, 7, 4, 7, 3>(simd, block, y, pairs),
        (2, 2, 2, _) => small::<2, 2>(block, y, pairs),
        _ => any(simd, block, (rows, columns, d), y, pairs),
    }
}

/// `Y` from a place on.
#[inline(always)]
fn matrix<const R: usize, const E: usize>(y: &[f64], at: usize) -> Option<&[[f64; R]; E]> {
    y.get(at..)?.as_chunks::<R>().0.first_chunk::<E>()
}

/// `R × C` with `E` columns of `Y`: `B` rows, of `V` vectors, are stored column after column, the
/// others, of `W` vectors and some numbers, each in one piece. So many sums as fit in registers are
/// kept at a time: those of `M` columns and of the last rows, then those of `N` columns.
#[inline(always)]
fn fixed<
    S: Simd,
    const V: usize,
    const W: usize,
    const M: usize,
    const N: usize,
    const R: usize,
    const B: usize,
    const C: usize,
    const E: usize,
>(
    simd: S,
    block: &mut [f64],
    y: &[f64],
    pairs: Pairs<'_>,
) {
    let (upper, lower) = block.split_at_mut(B * C);
    let (upper, _) = upper.as_chunks_mut::<B>();
    let (first, second) = upper.split_at_mut(M);
    match R - B {
        1 => part::<S, V, W, M, 1, R, B, C, E>(simd, first, 0, lower, y, pairs),
        2 => part::<S, V, W, M, 2, R, B, C, E>(simd, first, 0, lower, y, pairs),
        3 => part::<S, V, W, M, 3, R, B, C, E>(simd, first, 0, lower, y, pairs),
        _ => {}
    }
    if N > 0 {
        part::<S, V, W, N, 0, R, B, C, E>(simd, second, M, &mut [], y, pairs);
    }
}

/// Adds to the `N` columns from one on and to the last `L` rows.
#[inline(always)]
fn part<
    S: Simd,
    const V: usize,
    const W: usize,
    const N: usize,
    const L: usize,
    const R: usize,
    const B: usize,
    const C: usize,
    const E: usize,
>(
    simd: S,
    columns: &mut [[f64; B]],
    from: usize,
    rows: &mut [f64],
    y: &[f64],
    mut pairs: Pairs<'_>,
) {
    let (rows, _) = rows.as_chunks_mut::<C>();
    let (Some(columns), Some(rows)) = (columns.first_chunk_mut::<N>(), rows.first_chunk_mut::<L>())
    else {
        return;
    };
    let mut sum = [[simd.splat_f64s(0.0); V]; N];
    for c in 0..N {
        let Some(own) = vectors::<S, V>(&columns[c]) else {
            return;
        };
        sum[c] = own;
    }
    let mut row_sum = [[simd.splat_f64s(0.0); W]; L];
    let mut single = *rows;
    for r in 0..L {
        let Some(own) = vectors::<S, W>(&rows[r]) else {
            return;
        };
        row_sum[r] = own;
    }
    while let Some((i, j)) = pairs.next() {
        let (Some(left), Some(right)) = (matrix::<R, E>(y, i), matrix::<C, E>(y, j)) else {
            return;
        };
        for k in 0..E {
            let Some(own) = vectors::<S, V>(&left[k]) else {
                return;
            };
            for c in 0..N {
                let factor = simd.splat_f64s(right[k][from + c]);
                for v in 0..V {
                    sum[c][v] = simd.mul_add_e_f64s(own[v], factor, sum[c][v]);
                }
            }
            let Some(own) = vectors::<S, W>(&right[k]) else {
                return;
            };
            for r in 0..L {
                let factor = simd.splat_f64s(left[k][B + r]);
                for w in 0..W {
                    row_sum[r][w] = simd.mul_add_e_f64s(own[w], factor, row_sum[r][w]);
                }
                for c in W * S::F64_LANES..C {
                    single[r][c] += right[k][c] * left[k][B + r];
                }
            }
        }
    }
    for c in 0..N {
        write::<S, V>(&mut columns[c], sum[c]);
    }
    *rows = single;
    for r in 0..L {
        write::<S, W>(&mut rows[r], row_sum[r]);
    }
}

/// The first `V` vectors.
#[inline(always)]
fn vectors<S: Simd, const V: usize>(values: &[f64]) -> Option<[S::f64s; V]> {
    S::as_simd_f64s(values).0.first_chunk::<V>().copied()
}

/// Writes the first vectors.
#[inline(always)]
fn write<S: Simd, const V: usize>(values: &mut [f64], vectors: [S::f64s; V]) {
    if let Some(own) = S::as_mut_simd_f64s(values).0.first_chunk_mut::<V>() {
        *own = vectors;
    }
}

/// `R × R` of less than a vector.
#[inline(always)]
fn small<const R: usize, const E: usize>(block: &mut [f64], y: &[f64], mut pairs: Pairs<'_>) {
    let (block, _) = block.as_chunks_mut::<R>();
    let Some(block) = block.first_chunk_mut::<R>() else {
        return;
    };
    let mut sum = *block;
    while let Some((i, j)) = pairs.next() {
        let (Some(left), Some(right)) = (matrix::<R, E>(y, i), matrix::<R, E>(y, j)) else {
            return;
        };
        for k in 0..E {
            for c in 0..R {
                for r in 0..R {
                    sum[c][r] += left[k][r] * right[k][c];
                }
            }
        }
    }
    *block = sum;
}

#[inline(always)]
fn any<S: Simd>(
    simd: S,
    block: &mut [f64],
    (rows, columns, d): (usize, usize, usize),
    y: &[f64],
    mut pairs: Pairs<'_>,
) {
    let body = body(rows);
    let (upper, lower) = block.split_at_mut(body * columns);
    while let Some((i, j)) = pairs.next() {
        for k in 0..d {
            let left = &y[i + k * rows..][..rows];
            let right = &y[j + k * columns..][..columns];
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
}

/// `out += vector · factor`. By places: an iterator over both, where it is not inlined, is a call
/// for every number.
#[inline(always)]
pub(crate) fn add_multiple<S: Simd>(simd: S, out: &mut [f64], vector: &[f64], factor: f64) {
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
