//! Damped least squares by column-pivoted QR.

use std::borrow::Cow;
use std::cell::OnceCell;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::householder::{
    apply_block_householder_sequence_transpose_on_the_left_in_place_scratch as scratch,
    apply_block_householder_sequence_transpose_on_the_left_in_place_with_conj as apply_transpose,
};
use faer::linalg::solvers::{ColPivQr, SolveLstsqCore, Svd};
use faer::{Conj, Mat, MatMut, MatRef, Par};

use super::damped_triangle::damped_triangle;
use super::factor::Factor;
use super::householder::Householder;
use super::tall::Tall;
use super::triangle::Triangle;
use crate::linear::vector::{divide, dot, norm};

/// Most columns for which rotating the damping in is faster than a blocked QR.
const ROTATED_COLUMNS: usize = 32;

/// Most entries of a Jacobian that is factored on slices; beyond, faer's blocks are worth their set-up.
const SMALL: usize = 1 << 14;

/// Last entry of the diagonal of a pivoted `R`, relative to the first, up to which a direction is hardly seen.
const FAINT: f64 = 1e-6;

/// Most columns that are eliminated block of rows after block of rows, and how many times as many rows there have to be.
const SLENDER: usize = 32;
const TALL: usize = 64;

/// `J D⁻¹ P = Q R`, factored once; a damping then costs a QR of `2n × n` only.
///
/// The way of MINPACK: Moré, "The Levenberg-Marquardt algorithm: implementation and theory", 1978.
pub(crate) struct QrFactor {
    q: Orthogonal,
    /// `R`, its first `min(m, n)` rows.
    r: Triangle,
    /// The column of `J` at each place of `R`.
    order: Vec<usize>,
    scale: Vec<f64>,
    rank: usize,
    svd: OnceCell<Option<Svd<f64>>>,
    /// The first right side and its rotation: the residual comes again for every damping.
    first: OnceCell<(Vec<f64>, Vec<f64>)>,
}

/// `Q` as reflections.
enum Orthogonal {
    Small(Householder),
    Tall(Tall),
    Large(ColPivQr<f64>),
}

impl QrFactor {
    /// Factors `J D⁻¹` (`m × n`).
    pub fn new(jacobian: MatRef<'_, f64>, scale: &[f64]) -> Self {
        let (m, n) = jacobian.shape();
        let (q, r, order) = if m * n <= SMALL {
            small(jacobian, scale)
        } else if (1..=SLENDER).contains(&n) && m >= TALL * n {
            tall(jacobian, scale)
        } else {
            large(jacobian, scale)
        };
        let rank = numerical_rank(&r, m);
        Self {
            q,
            r,
            order,
            scale: scale.to_vec(),
            rank,
            svd: OnceCell::new(),
            first: OnceCell::new(),
        }
    }

    /// `Qᵀ b`, its first `min(m, n)` entries.
    fn rotated(&self, b: &[f64]) -> Cow<'_, [f64]> {
        let (first, rotated) = self.first.get_or_init(|| (b.to_vec(), self.rotate(b)));
        if first == b {
            Cow::Borrowed(rotated)
        } else {
            Cow::Owned(self.rotate(b))
        }
    }

    fn rotate(&self, b: &[f64]) -> Vec<f64> {
        let mut rotated = b.to_vec();
        match &self.q {
            Orthogonal::Small(qr) => qr.rotate(&mut rotated),
            Orthogonal::Tall(qr) => qr.rotate(&mut rotated),
            Orthogonal::Large(qr) => rotate(qr, &mut rotated),
        }
        rotated.truncate(self.r.rows());
        rotated
    }

    /// `R Pᵀ D`: at most `n` rows with the `JᵀJ` of the Jacobian.
    pub fn root(&self) -> Mat<f64> {
        let mut root = Mat::zeros(self.r.rows(), self.r.columns());
        for (place, &column) in self.order.iter().enumerate() {
            for i in 0..root.nrows().min(place + 1) {
                root[(i, column)] = self.r.row(i)[place] * self.scale[column];
            }
        }
        root
    }

    /// A direction that the Jacobian sees little of, the last of the pivoted columns less what the
    /// others say of it, as a change of the parameters with `‖D v‖ = 1`.
    pub fn least_seen(&self) -> Option<Vec<f64>> {
        let n = self.scale.len();
        let last = self.rank.min(n.checked_sub(1)?);
        let mut w = vec![0.0; n];
        w[last] = 1.0;
        for i in (0..last).rev() {
            let known = dot(&self.r.row(i)[i + 1..=last], &w[i + 1..=last]);
            w[i] = -known / self.r.diagonal(i);
        }
        let length = norm(&w);
        self.restore(|k| w[k] / length)
    }

    /// [`least_seen`](Self::least_seen) where the Jacobian sees next to nothing of it.
    pub fn unseen(&self) -> Option<Vec<f64>> {
        let last = self.scale.len().checked_sub(1)?;
        let short = self.r.rows() <= last
            || self.r.diagonal(last).abs() <= FAINT * self.r.diagonal(0).abs();
        short.then(|| self.least_seen()).flatten()
    }

    /// Undoes pivoting and scaling: `p = D⁻¹ P w`.
    fn restore(&self, w: impl Fn(usize) -> f64) -> Option<Vec<f64>> {
        let mut p = vec![0.0; self.scale.len()];
        for (place, &column) in self.order.iter().enumerate() {
            p[column] = w(place) / self.scale[column];
        }
        p.iter().all(|v| v.is_finite()).then_some(p)
    }

    /// Back substitution where the rank is full.
    fn triangular(&self, q: &[f64]) -> Option<Vec<f64>> {
        let n = self.scale.len();
        let mut w = vec![0.0; n];
        for i in (0..n).rev() {
            let known = dot(&self.r.row(i)[i + 1..], &w[i + 1..]);
            w[i] = (-q[i] - known) / self.r.diagonal(i);
        }
        self.restore(|k| w[k])
    }

    /// The truncated pseudoinverse of `R` where the rank is short.
    fn truncated(&self, q: &[f64]) -> Option<Vec<f64>> {
        let svd = self
            .svd
            .get_or_init(|| self.r.to_mat().thin_svd().ok())
            .as_ref()?;
        let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
        let coefficient = |j: usize| -(0..q.len()).map(|i| u[(i, j)] * q[i]).sum::<f64>() / s[j];
        let c: Vec<f64> = (0..self.rank).map(coefficient).collect();
        self.restore(|k| c.iter().enumerate().map(|(j, c)| v[(k, j)] * c).sum())
    }
}

impl Factor for QrFactor {
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        let (r, q) = (&self.r, self.rotated(b));
        let w = if self.scale.len() <= ROTATED_COLUMNS {
            damped_triangle(r, &q, lambda)
        } else {
            damped_stack(r, &q, lambda)
        };
        self.restore(|k| w[k])
    }

    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> {
        let q = self.rotated(b);
        if self.rank == self.scale.len() {
            self.triangular(&q)
        } else {
            self.truncated(&q)
        }
    }

    fn tangential(&self, b: &[f64]) -> f64 {
        norm(&self.rotated(b)[..self.rank])
    }
}

fn small(jacobian: MatRef<'_, f64>, scale: &[f64]) -> (Orthogonal, Triangle, Vec<usize>) {
    let (m, n) = jacobian.shape();
    let mut columns = Vec::with_capacity(m * n);
    for (column, &scale) in jacobian.col_iter().zip(scale) {
        let first = columns.len();
        columns.extend(column.iter());
        divide(&mut columns[first..], scale);
    }
    let (qr, order) = Householder::new(columns, m, n);
    let r = qr.triangle();
    (Orthogonal::Small(qr), r, order)
}

fn tall(jacobian: MatRef<'_, f64>, scale: &[f64]) -> (Orthogonal, Triangle, Vec<usize>) {
    let contiguous = jacobian.try_as_col_major();
    let Some(jacobian) = contiguous else {
        return large(jacobian, scale);
    };
    let (qr, order) = Tall::new(|k| jacobian.col(k).as_slice(), scale);
    let r = qr.triangle();
    (Orthogonal::Tall(qr), r, order)
}

fn large(jacobian: MatRef<'_, f64>, scale: &[f64]) -> (Orthogonal, Triangle, Vec<usize>) {
    let (m, n) = jacobian.shape();
    let qr = Mat::from_fn(m, n, |i, k| jacobian[(i, k)] / scale[k]).col_piv_qr();
    let r = qr.thin_R();
    let r = Triangle::from_fn(r.nrows(), n, |i, k| r[(i, k)]);
    let order = qr.P().arrays().0.to_vec();
    (Orthogonal::Large(qr), r, order)
}

/// Replaces `b` by `Qᵀ b`.
fn rotate(qr: &ColPivQr<f64>, b: &mut [f64]) {
    let (basis, coefficients) = (qr.Q_basis(), qr.Q_coeff());
    let mut memory = MemBuffer::new(scratch::<f64>(basis.nrows(), coefficients.nrows(), 1));
    apply_transpose(
        basis,
        coefficients,
        Conj::No,
        MatMut::from_column_major_slice_mut(b, basis.nrows(), 1),
        Par::Seq,
        MemStack::new(&mut memory),
    );
}

/// `argmin ‖R w + q‖² + λ ‖w‖²` by a QR of `R` stacked on `√λ I`.
fn damped_stack(r: &Triangle, q: &[f64], lambda: f64) -> Vec<f64> {
    let (rows, n) = (r.rows(), r.columns());
    let root = lambda.sqrt();
    let stacked = Mat::from_fn(rows + n, n, |i, k| match i < rows {
        true => r.row(i)[k],
        false if i == rows + k => root,
        false => 0.0,
    });
    let mut w = Mat::from_fn(rows + n, 1, |i, _| if i < rows { -q[i] } else { 0.0 });
    stacked
        .qr()
        .solve_lstsq_in_place_with_conj(Conj::No, w.as_mut());
    (0..n).map(|k| w[(k, 0)]).collect()
}

/// Number of diagonal entries of a pivoted `R` above rounding: `10 ε max(m, n) |R₁₁|`.
fn numerical_rank(r: &Triangle, m: usize) -> usize {
    let size = r.rows();
    if size == 0 {
        return 0;
    }
    let floor =
        10.0 * f64::EPSILON * (m as f64).sqrt().max(r.columns() as f64) * r.diagonal(0).abs();
    (0..size)
        .take_while(|&k| r.diagonal(k).abs() > floor)
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tall() -> Mat<f64> {
        Mat::from_fn(7, 3, |i, k| ((i * 5 + k * 3 + i * i * k) % 11) as f64 - 4.0)
    }

    #[test]
    fn damped_step_satisfies_the_normal_equations() {
        let (j, scale, b, lambda) = (
            tall(),
            [2.0, 0.5, 3.0],
            [1.0, -2.0, 0.5, 4.0, 1.0, 0.0, -1.0],
            0.3,
        );
        let p = QrFactor::new(j.as_ref(), &scale)
            .damped(&b, lambda)
            .unwrap();
        let inside: Vec<f64> = (0..7)
            .map(|i| (0..3).map(|k| j[(i, k)] * p[k]).sum::<f64>() + b[i])
            .collect();
        for k in 0..3 {
            let gradient: f64 = (0..7).map(|i| j[(i, k)] * inside[i]).sum();
            assert!((gradient + lambda * scale[k] * scale[k] * p[k]).abs() < 1e-12);
        }
    }

    #[test]
    fn least_seen_is_what_dependent_columns_do_not_see() {
        // The third column is twice the first less three times the second.
        let two = tall();
        let j = Mat::from_fn(7, 3, |i, k| match k {
            2 => 2.0 * two[(i, 0)] - 3.0 * two[(i, 1)],
            _ => two[(i, k)],
        });
        let scale = [2.0, 0.5, 3.0];
        let v = QrFactor::new(j.as_ref(), &scale).least_seen().unwrap();
        for i in 0..7 {
            let seen: f64 = (0..3).map(|k| j[(i, k)] * v[k]).sum();
            assert!(seen.abs() < 1e-12, "{seen}");
        }
        let length: f64 = (0..3).map(|k| (scale[k] * v[k]).powi(2)).sum();
        assert!((length - 1.0).abs() < 1e-12, "{length}");
    }

    #[test]
    fn rotating_the_damping_in_equals_the_qr_of_the_stack() {
        for (rows, n) in [(1, 1), (3, 3), (2, 5), (9, 9)] {
            let r = Triangle::from_fn(rows, n, |i, k| {
                ((i * 5 + k * 3 + i * i * k) % 11) as f64 - 4.0
            });
            let q: Vec<f64> = (0..rows).map(|i| 1.0 - 0.7 * i as f64).collect();
            for lambda in [1e-3, 0.3, 1e6] {
                let fast = damped_triangle(&r, &q, lambda);
                let simple = damped_stack(&r, &q, lambda);
                let size = norm(&simple);
                for (a, b) in fast.iter().zip(&simple) {
                    // The condition is at most ‖R‖ / √λ < 3e3.
                    assert!((a - b).abs() < 1e-11 * size, "{rows} {n} {lambda}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn small_and_large_matrices_are_solved_alike() {
        let (m, n) = (SMALL / 4 + 1, 4);
        let wave = |i: usize, k: usize| (0.37 * (i * (k + 1)) as f64 + k as f64).sin();
        let j = Mat::from_fn(m, n, wave);
        let (scale, b) = ([1.0, 2.0, 0.5, 4.0], wave_column(m));
        let factor = |parts: (Orthogonal, Triangle, Vec<usize>)| QrFactor {
            rank: n,
            q: parts.0,
            r: parts.1,
            order: parts.2,
            scale: scale.to_vec(),
            svd: OnceCell::new(),
            first: OnceCell::new(),
        };
        let simple = factor(large(j.as_ref(), &scale));
        for fast in [small(j.as_ref(), &scale), super::tall(j.as_ref(), &scale)] {
            let fast = factor(fast);
            assert!((fast.tangential(&b) / simple.tangential(&b) - 1.0).abs() < 1e-12);
            let pairs = [
                (fast.undamped(&b), simple.undamped(&b)),
                (fast.damped(&b, 0.1), simple.damped(&b, 0.1)),
            ];
            for (fast, simple) in pairs {
                for (a, b) in fast.unwrap().iter().zip(&simple.unwrap()) {
                    // Columns of sines are nearly orthogonal: the condition is near 1.
                    assert!((a - b).abs() < 1e-13, "{a} {b}");
                }
            }
        }
    }

    fn wave_column(m: usize) -> Vec<f64> {
        (0..m).map(|i| (0.11 * i as f64).cos() + 0.2).collect()
    }

    #[test]
    fn the_root_has_the_normal_matrix_of_the_jacobian() {
        let j = tall();
        let root = QrFactor::new(j.as_ref(), &[2.0, 0.5, 3.0]).root();
        let difference = root.transpose() * &root - j.transpose() * &j;
        assert!(difference.norm_l2() < 1e-13 * j.norm_l2().powi(2));
    }

    #[test]
    fn short_rank_gives_the_shortest_scaled_step() {
        let two = Mat::from_fn(4, 2, |i, _| i as f64 + 1.0);
        let p = QrFactor::new(two.as_ref(), &[1.0, 1.0])
            .undamped(&[-2.0, -4.0, -6.0, -8.0])
            .unwrap();
        assert!((p[0] - 1.0).abs() < 1e-14 && (p[1] - 1.0).abs() < 1e-14);
    }
}
