//! QR of matrices of many more rows than columns, in one pass over the rows.

use pulp::{Arch, Simd, WithSimd};

use super::householder::{Householder, reflection};
use super::triangle::Triangle;

/// Rows that are eliminated together: with some ten columns they stay in the fastest memory.
const ROWS: usize = 256;

/// `A P = Q R`: blocks of rows are eliminated one after the other against an upper triangle, which is then factored with pivoting.
///
/// A factorisation by columns reads the whole matrix once for each of them.
///
/// Source: Demmel, Grigori, Hoemmen and Langou, "Communication-optimal parallel and sequential QR and LU factorizations", 2012,
/// the sequential one.
pub(crate) struct Tall {
    rows: usize,
    columns: usize,
    /// Rows of each block as they are left, column after column: the `v` of its reflections below their leading 1.
    blocks: Vec<f64>,
    /// `τ` of every reflection, `columns` a block.
    taus: Vec<f64>,
    /// The triangle that is left, factored.
    inner: Householder,
}

impl Tall {
    /// Factors the matrix whose columns `column(k)` are as long as one another and longer than their number, each divided by its
    /// `scale`; with the column of `A` at each place of `R`.
    pub fn new<'a>(column: impl Fn(usize) -> &'a [f64], scale: &[f64]) -> (Self, Vec<usize>) {
        let (rows, n) = (column(0).len(), scale.len());
        let mut blocks = vec![0.0; rows * n];
        let inverse: Vec<f64> = scale.iter().map(|s| s.recip()).collect();
        for (block, first) in blocks.chunks_mut(ROWS * n).zip((0..).step_by(ROWS)) {
            let count = block.len() / n;
            for (k, part) in block.chunks_exact_mut(count).enumerate() {
                let from = &column(k)[first..first + count];
                match inverse[k].is_normal() {
                    true => (part.iter_mut().zip(from)).for_each(|(a, b)| *a = b * inverse[k]),
                    false => (part.iter_mut().zip(from)).for_each(|(a, b)| *a = b / scale[k]),
                }
            }
        }
        let mut taus = vec![0.0; rows.div_ceil(ROWS) * n];
        let mut triangle = vec![0.0; n * n];
        Arch::new().dispatch(Elimination {
            blocks: &mut blocks,
            taus: &mut taus,
            triangle: &mut triangle,
            n,
        });
        let (inner, order) = Householder::new(triangle, n, n);
        let tall = Self {
            rows,
            columns: n,
            blocks,
            taus,
            inner,
        };
        (tall, order)
    }

    /// `R` (`n × n`).
    pub fn triangle(&self) -> Triangle {
        self.inner.triangle()
    }

    /// Replaces `b` (`rows`) by the first `n` entries of `Qᵀ b`.
    pub fn rotate(&self, b: &mut Vec<f64>) {
        debug_assert_eq!(b.len(), self.rows);
        let mut head = vec![0.0; self.columns];
        Arch::new().dispatch(Rotation {
            tall: self,
            b,
            head: &mut head,
        });
        self.inner.rotate(&mut head);
        *b = head;
    }
}

/// All blocks against the triangle, which lies column after column.
struct Elimination<'a> {
    blocks: &'a mut [f64],
    taus: &'a mut [f64],
    triangle: &'a mut [f64],
    n: usize,
}

impl WithSimd for Elimination<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let n = self.n;
        let blocks = self.blocks.chunks_mut(ROWS * n);
        for (block, taus) in blocks.zip(self.taus.chunks_exact_mut(n)) {
            let count = block.len() / n;
            for k in 0..n {
                let (before, after) = block.split_at_mut((k + 1) * count);
                let v = &mut before[k * count..];
                let diagonal = &mut self.triangle[k * n + k];
                let (d, tau) = onto(diagonal, v);
                *diagonal = d;
                taus[k] = tau;
                for (column, place) in after.chunks_exact_mut(count).zip(k + 1..) {
                    reflect(v, tau, &mut self.triangle[place * n + k], column);
                }
            }
        }
    }
}

/// `Qᵀ b` but for the inner factor, its first entries into `head`.
struct Rotation<'a> {
    tall: &'a Tall,
    b: &'a mut [f64],
    head: &'a mut [f64],
}

impl WithSimd for Rotation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let n = self.tall.columns;
        let blocks = self.tall.blocks.chunks(ROWS * n);
        let taus = self.tall.taus.chunks_exact(n);
        for ((block, taus), b) in blocks.zip(taus).zip(self.b.chunks_mut(ROWS)) {
            for ((v, tau), head) in block.chunks_exact(b.len()).zip(taus).zip(&mut *self.head) {
                reflect(v, *tau, head, b);
            }
        }
    }
}

/// Turns `x` below a leading entry into the `v` of the reflection that maps both to `(d, 0, …)`; returns `d` and `τ`.
#[inline(always)]
fn onto(first: &f64, x: &mut [f64]) -> (f64, f64) {
    let square = dot(x, x) + first * first;
    if !square.is_normal() {
        // Too large or too small to be squared, or zero: the careful way.
        let mut whole = Vec::with_capacity(x.len() + 1);
        whole.push(*first);
        whole.extend_from_slice(x);
        let found = reflection(&mut whole);
        x.copy_from_slice(&whole[1..]);
        return found;
    }
    let d = -square.sqrt().copysign(*first);
    let inverse = 1.0 / (first - d);
    x.iter_mut().for_each(|value| *value *= inverse);
    (d, (d - first) / d)
}

/// `(head, c) − τ (1, v) (1, v)ᵀ (head, c)`.
#[inline(always)]
fn reflect(v: &[f64], tau: f64, head: &mut f64, c: &mut [f64]) {
    let along = tau * (*head + dot(v, c));
    *head -= along;
    let length = v.len().min(c.len());
    let (v, c) = (&v[..length], &mut c[..length]);
    for i in 0..length {
        c[i] -= along * v[i];
    }
}

/// `a · b` in sixteen sums: as many as fill the machine's vectors.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let length = a.len().min(b.len());
    let (a, a_rest) = a[..length].as_chunks::<16>();
    let (b, b_rest) = b[..length].as_chunks::<16>();
    let mut sums = [0.0; 16];
    for (a, b) in a.iter().zip(b) {
        for k in 0..16 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;
    use crate::linear::vector::norm;

    #[test]
    fn is_the_factorisation_of_faer_up_to_signs() {
        for (m, n) in [(ROWS, 1), (2 * ROWS, 3), (3 * ROWS + 17, 9), (ROWS + 1, 6)] {
            let a = Mat::from_fn(m, n, |i, k| {
                (1.7 * (i * (k + 1) + k * k) as f64).cos() * (1.0 + k as f64)
            });
            let scale: Vec<f64> = (0..n).map(|k| 0.5 + k as f64).collect();
            let (tall, order) = Tall::new(|k| a.col_as_slice(k), &scale);
            let scaled = Mat::from_fn(m, n, |i, k| a[(i, k)] / scale[k]);
            let large = scaled.col_piv_qr();
            assert_eq!(order, large.P().arrays().0, "{m} {n}");
            let b: Vec<f64> = (0..m).map(|i| (0.3 * i as f64).sin() - 0.2).collect();
            let mut rotated = b.clone();
            tall.rotate(&mut rotated);
            let oracle = large.compute_thin_Q().transpose() * Mat::from_fn(m, 1, |i, _| b[i]);
            let (r, size) = (tall.triangle(), norm(&b) + scaled.norm_l2());
            assert_eq!(rotated.len(), n);
            for i in 0..n {
                for k in i..n {
                    let difference = r.row(i)[k].abs() - large.thin_R()[(i, k)].abs();
                    assert!(difference.abs() < 1e-13 * size, "{m} {n}: R {i} {k}");
                }
                let difference = rotated[i].abs() - oracle[(i, 0)].abs();
                assert!(difference.abs() < 1e-13 * size, "{m} {n}: Qᵀb {i}");
            }
        }
    }

    #[test]
    fn columns_of_zeros_and_of_numbers_too_small_to_be_squared_are_factored() {
        let m = ROWS + 3;
        let columns = [vec![0.0; m], vec![1e-200; m], vec![3e180; m]];
        let (tall, order) = Tall::new(|k| &columns[k], &[1.0; 3]);
        let r = tall.triangle();
        let root = (m as f64).sqrt();
        assert_eq!(order[0], 2);
        assert!((r.diagonal(0).abs() / (3e180 * root) - 1.0).abs() < 1e-13);
        assert!((1..3).all(|i| r.diagonal(i).abs() < 1e-200));
        assert!((r.row(0)[1].abs() / (1e-200 * root) - 1.0).abs() < 1e-13 || r.row(0)[1] == 0.0);
    }
}
