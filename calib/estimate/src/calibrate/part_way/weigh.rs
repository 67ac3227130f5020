//! Whether an explanation is better than chance makes it.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

/// Chance makes so good an explanation this rarely, over all that were tried.
const CHANCE: f64 = 1e-4;

/// What is left after it is at most this share of the sum of squares before it.
const LEFT: f64 = 1.0 / 9.0;

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

    /// Whether it is beyond chance, among `tried` of them, where the base leaves `base` with `freedom` degrees.
    pub fn holds(&self, base: f64, freedom: usize, tried: usize) -> bool {
        let Some(spare) = freedom.checked_sub(self.parameters).filter(|&s| s >= 2) else {
            return false;
        };
        if self.left > LEFT * base {
            return false;
        }
        let q = self.parameters.max(1) as f64;
        let f = (base - self.left) / q / (self.left.max(f64::MIN_POSITIVE) / spare as f64);
        let Ok(chance) = FisherSnedecor::new(q, spare as f64) else {
            return false;
        };
        chance.sf(f) * (tried as f64) < CHANCE
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
