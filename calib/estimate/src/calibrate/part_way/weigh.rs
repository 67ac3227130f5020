//! Significance test of an explanation.

use nalgebra::{DMatrix, DVector};

use crate::methods::chance;

findings::tuning! {
    /// Chance makes so good an explanation this rarely, over all that were tried.
    CHANCE: f64 = 1e-4;

    /// Largest share of the sum of squares that an explanation may leave.
    LEFT: f64 = 1.0 / 9.0;
}

/// An explanation: what it leaves of a sum of squares, with how many parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Explanation {
    /// Sum of squares that is left.
    pub left: f64,
    /// Parameters beyond those of the base.
    pub parameters: usize,
}

impl Explanation {
    /// Schwarz's criterion over `rows`, smaller for the better; sums of squares below `floor` are alike.
    pub fn criterion(&self, rows: usize, floor: f64) -> f64 {
        let n = rows as f64;
        n * self.left.max(floor).ln() + self.parameters as f64 * n.ln()
    }

    /// Returns true if it is significant among `tried` explanations, where the base leaves the sum of squares `base` with
    /// `freedom` degrees.
    pub fn holds(&self, base: f64, freedom: usize, tried: usize) -> bool {
        let Some(spare) = freedom.checked_sub(self.parameters).filter(|&s| s >= 2) else {
            return false;
        };
        if self.left > LEFT.get() * base {
            return false;
        }
        let q = self.parameters.max(1) as f64;
        let f = (base - self.left) / q / (self.left.max(f64::MIN_POSITIVE) / spare as f64);
        chance::of_f(f, [q, spare as f64]) * (tried as f64) < CHANCE.get()
    }
}

/// The solution of `normal x = right`, `normal` symmetric, with a little damping.
pub(super) fn solved(
    normal: &DMatrix<f64>,
    right: &DVector<f64>,
    damping: f64,
) -> Option<DVector<f64>> {
    let mut damped = normal.clone();
    let largest = normal.diagonal().max();
    for k in 0..normal.nrows() {
        damped[(k, k)] += damping * normal[(k, k)] + 1e-12 * largest;
    }
    Some(damped.cholesky()?.solve(right)).filter(|x| x.iter().all(|v| v.is_finite()))
}

/// The same as [`solved`] without a heap: hundreds of small fits are compared. The lower triangle of `normal`, the first
/// `m` rows and columns.
pub(super) fn solved_in_place<const ALL: usize>(
    mut normal: [[f64; ALL]; ALL],
    mut right: [f64; ALL],
    m: usize,
    damping: f64,
) -> Option<[f64; ALL]> {
    let largest = (0..m)
        .map(|k| normal[k][k])
        .fold(f64::NEG_INFINITY, f64::max);
    for (k, row) in normal.iter_mut().enumerate().take(m) {
        row[k] += damping * row[k] + 1e-12 * largest;
    }
    for i in 0..m {
        for k in 0..=i {
            let sum: f64 = (0..k).map(|j| normal[i][j] * normal[k][j]).sum();
            let value = normal[i][k] - sum;
            if i > k {
                normal[i][k] = value / normal[k][k];
            } else if value > 0.0 {
                normal[i][i] = value.sqrt();
            } else {
                return None;
            }
        }
        let sum: f64 = (0..i).map(|j| normal[i][j] * right[j]).sum();
        right[i] = (right[i] - sum) / normal[i][i];
    }
    for i in (0..m).rev() {
        let sum: f64 = (i + 1..m).map(|j| normal[j][i] * right[j]).sum();
        right[i] = (right[i] - sum) / normal[i][i];
    }
    right[..m].iter().all(|v| v.is_finite()).then_some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: usize = 12;

    #[test]
    fn small_normal_equations_are_solved_as_large_ones() {
        let slopes = |i: usize, k: usize| ((i * 7 + k * 5 + i * k) % 11) as f64 - 5.0;
        for m in [9, ALL] {
            let a = DMatrix::from_fn(30, m, slopes);
            let (whole, b) = (
                a.transpose() * &a,
                DVector::from_fn(m, |i, _| i as f64 - 3.0),
            );
            let mut normal = [[0.0; ALL]; ALL];
            let mut right = [0.0; ALL];
            for i in 0..m {
                right[i] = b[i];
                for k in 0..=i {
                    normal[i][k] = whole[(i, k)];
                }
            }
            let exact = solved(&whole, &b, 0.1).unwrap();
            let found = solved_in_place(normal, right, m, 0.1).unwrap();
            for k in 0..m {
                assert!((found[k] - exact[k]).abs() < 1e-12, "{m} {k}");
            }
        }
    }
}
