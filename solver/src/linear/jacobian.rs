//! The problem linearised at a point.

use faer::Mat;

use super::cholesky::CholeskyFactor;
use super::factor::Factor;
use super::method::LinearSolver;
use super::product::{multiply, not_finite, transpose_multiply};
use super::qr::QrFactor;
use super::vector::norm;

/// Residuals, cost and Jacobian at one point.
#[derive(Clone, Debug)]
pub(crate) struct Linearization {
    /// `r` (`m`), corrected for the loss.
    pub residuals: Vec<f64>,
    /// Minimised cost: `½ ‖r‖²`, or half the sum of the losses.
    pub cost: f64,
    /// `∂r/∂x` (`m × n`), free columns only.
    pub jacobian: Jacobian,
}

/// A dense Jacobian (`m × n`).
#[derive(Clone, Debug)]
pub(crate) struct Jacobian(pub Mat<f64>);

impl Jacobian {
    /// `‖J_k‖` of every column.
    pub fn column_norms(&self) -> Vec<f64> {
        let j = &self.0;
        (0..j.ncols()).map(|k| norm(j.col_as_slice(k))).collect()
    }

    /// `J p`.
    pub fn multiply(&self, p: &[f64]) -> Vec<f64> {
        multiply(self.0.as_ref(), p)
    }

    /// `Jᵀ b`.
    pub fn transpose_multiply(&self, b: &[f64]) -> Vec<f64> {
        transpose_multiply(self.0.as_ref(), b)
    }

    /// Factors `J D⁻¹`.
    pub fn factor(&self, scale: &[f64], solver: LinearSolver) -> Box<dyn Factor + '_> {
        let j = self.0.as_ref();
        match solver {
            LinearSolver::Qr => Box::new(QrFactor::new(j, scale)),
            LinearSolver::Cholesky => Box::new(CholeskyFactor::new(j, scale)),
            LinearSolver::Own(own) => own.0.factor(j, scale),
        }
    }

    /// Scales row `i` by `factors[i]`.
    pub fn scale_rows(&mut self, factors: &[f64]) {
        for column in self.0.col_iter_mut() {
            for (value, factor) in column.iter_mut().zip(factors) {
                *value *= factor;
            }
        }
    }

    /// Row and column of the first entry that is not finite.
    pub fn not_finite(&self) -> Option<(usize, usize)> {
        not_finite(&self.0)
    }
}
