//! QR of small matrices, on slices.

use super::triangle::Triangle;
use crate::linear::vector::{add_to, divide, dot, norm};

/// Share of a column's norm, squared, below which the norm is measured again and not updated.
const CANCELLED: f64 = 1.5e-8;

/// `A P = Q R` by Householder reflections `I − τ v vᵀ`.
///
/// For matrices so small that a blocked factorisation costs more to set up than it saves.
///
/// Source: Businger and Golub, "Linear least squares solutions by Householder transformations",
/// 1965.
pub(crate) struct Householder {
    rows: usize,
    /// Column after column: `R` above the diagonal, `v` (its first entry 1) from the diagonal on.
    columns: Vec<f64>,
    /// For every reflection, the diagonal entry of `R` that it leaves, and `τ`.
    reflections: Vec<(f64, f64)>,
}

impl Householder {
    /// Factors the matrix of `n` columns of length `rows` that lie one after the other; with the
    /// column of `A` at each place of `R`.
    pub fn new(columns: Vec<f64>, rows: usize, n: usize) -> (Self, Vec<usize>) {
        let size = rows.min(n);
        let mut factor = Self {
            rows,
            columns,
            reflections: Vec::with_capacity(size),
        };
        let mut order: Vec<usize> = (0..n).collect();
        let mut norms: Vec<Norm> = (0..n).map(|k| Norm::of(factor.column(k))).collect();
        for k in 0..size {
            factor.bring_largest(k, &mut norms, &mut order);
            factor.eliminate(k, &mut norms);
        }
        (factor, order)
    }

    /// `R` (`min(rows, n) × n`).
    pub fn triangle(&self) -> Triangle {
        let n = self.columns.len().checked_div(self.rows).unwrap_or(0);
        Triangle::from_fn(self.reflections.len(), n, |i, k| match i == k {
            true => self.reflections[i].0,
            false => self.columns[k * self.rows + i],
        })
    }

    /// Replaces `b` (`rows`) by `Qᵀ b`.
    pub fn rotate(&self, b: &mut [f64]) {
        for (k, &(_, tau)) in self.reflections.iter().enumerate() {
            reflect(&self.column(k)[k..], tau, &mut b[k..]);
        }
    }

    fn column(&self, k: usize) -> &[f64] {
        &self.columns[k * self.rows..(k + 1) * self.rows]
    }

    /// Swaps the longest of the columns that are left into place `k`.
    fn bring_largest(&mut self, k: usize, norms: &mut [Norm], order: &mut [usize]) {
        let longest = (k..norms.len()).max_by(|&a, &b| norms[a].square.total_cmp(&norms[b].square));
        let Some(pivot) = longest.filter(|&pivot| pivot > k) else {
            return;
        };
        let (before, after) = self.columns.split_at_mut(pivot * self.rows);
        before[k * self.rows..(k + 1) * self.rows].swap_with_slice(&mut after[..self.rows]);
        norms.swap(k, pivot);
        order.swap(k, pivot);
    }

    /// Reflects column `k` onto the diagonal, and all columns after it.
    fn eliminate(&mut self, k: usize, norms: &mut [Norm]) {
        let (before, after) = self.columns.split_at_mut((k + 1) * self.rows);
        let v = &mut before[k * self.rows + k..];
        let (diagonal, tau) = reflection(v);
        for (column, norm) in after.chunks_exact_mut(self.rows).zip(&mut norms[k + 1..]) {
            reflect(v, tau, &mut column[k..]);
            norm.without_first(&column[k..]);
        }
        self.reflections.push((diagonal, tau));
    }
}

/// Turns `x` into the `v` of the reflection that maps `x` to `(d, 0, …)`; returns `d` and `τ`.
pub(super) fn reflection(x: &mut [f64]) -> (f64, f64) {
    let length = norm(x);
    let first = std::mem::replace(&mut x[0], 1.0);
    if length == 0.0 {
        return (0.0, 0.0);
    }
    let d = -length.copysign(first);
    divide(&mut x[1..], first - d);
    (d, (d - first) / d)
}

/// `c − τ v (vᵀ c)`.
fn reflect(v: &[f64], tau: f64, c: &mut [f64]) {
    let along = tau * dot(v, c);
    add_to(c, -along, v);
}

/// The square of the norm of what is left of a column.
#[derive(Clone, Copy)]
struct Norm {
    square: f64,
    measured: f64,
}

impl Norm {
    fn of(column: &[f64]) -> Self {
        let square = dot(column, column);
        Self {
            square,
            measured: square,
        }
    }

    /// Leaves out the first entry: by Pythagoras, or measured again where that cancels.
    fn without_first(&mut self, column: &[f64]) {
        self.square -= column[0] * column[0];
        if self.square <= CANCELLED * self.measured {
            *self = Self::of(&column[1..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use faer::Mat;

    use super::*;

    /// A matrix of full rank.
    fn waves(m: usize, n: usize) -> Mat<f64> {
        Mat::from_fn(m, n, |i, k| (1.7 * (i * (k + 1) + k * k) as f64).cos())
    }

    #[test]
    fn is_the_factorisation_of_faer_up_to_signs() {
        for (m, n) in [(1, 1), (7, 3), (9, 9), (3, 5), (40, 8)] {
            let a = waves(m, n);
            let columns = (0..n).flat_map(|k| a.col_as_slice(k).to_vec()).collect();
            let (small, order) = Householder::new(columns, m, n);
            let large = a.col_piv_qr();
            let (forward, _) = large.P().arrays();
            let r = small.triangle();
            assert_eq!(order, forward, "{m} {n}");
            let b: Vec<f64> = (0..m).map(|i| 1.0 - 0.7 * i as f64).collect();
            let mut rotated = b.clone();
            small.rotate(&mut rotated);
            let oracle = large.compute_Q().transpose() * Mat::from_fn(m, 1, |i, _| b[i]);
            let size = norm(&b) + a.norm_l2();
            for i in 0..m.min(n) {
                for k in 0..n {
                    let difference = r.row(i)[k].abs() - large.thin_R()[(i, k)].abs();
                    let expected = if k < i { r.row(i)[k] } else { difference };
                    assert!(expected.abs() < 1e-13 * size, "{m} {n}: R {i} {k}");
                }
                let difference = rotated[i].abs() - oracle[(i, 0)].abs();
                assert!(difference.abs() < 1e-13 * size, "{m} {n}: Qᵀb {i}");
            }
        }
    }

    #[test]
    fn a_column_of_zeros_and_one_that_repeats_leave_zeros_on_the_diagonal() {
        let x = [1.0, 2.0, 3.0];
        let columns = [[0.0; 3], x, x].concat();
        let (factor, _) = Householder::new(columns, 3, 3);
        let r = factor.triangle();
        assert!((r.diagonal(0).abs() - 14f64.sqrt()).abs() < 1e-15);
        assert!(r.diagonal(1).abs() < 1e-15 && r.diagonal(2).abs() < 1e-15);
    }
}
