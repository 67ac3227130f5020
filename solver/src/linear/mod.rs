//! The problem linearised at a point, `r + J p`, and the ways to solve for `p`.

pub(crate) mod vector;

mod cholesky;
mod damped_triangle;
mod householder;
mod jacobi;
mod minimum_norm;
mod qr;
mod triangle;

pub(crate) use cholesky::CholeskyFactor;
use damped_triangle::damped_triangle;
use faer::{Mat, MatRef};
use householder::Householder;
pub(crate) use jacobi::singular;
pub(crate) use minimum_norm::minimum_norm;
pub(crate) use qr::QrFactor;
use serde::{Deserialize, Serialize};
use triangle::Triangle;

use crate::linear::vector::{add_to, dot, norm};

/// How the damped linear problem is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum LinearSolver {
    /// Column-pivoted QR of the Jacobian, factored once per point and reused for every damping.
    #[default]
    Qr,
    /// Cholesky of the normal equations where they are safely positive definite, QR elsewhere;
    /// half the work for tall Jacobians, half the digits.
    Cholesky,
    /// One's own; it is not written (`serde` refuses it).
    #[serde(skip)]
    Own(OwnLinearSolver),
}

/// A way to factor a Jacobian, to be used as [`LinearSolver::own`].
///
/// ```
/// use stillpoint_solver::{Factorization, LinearMethod, LinearSolver, MatRef};
///
/// /// One parameter: `p = −Jᵀb / (JᵀJ + λ D²)`.
/// struct Single;
///
/// struct Column { entries: Vec<f64>, scale: f64 }
///
/// impl LinearMethod for Single {
///     fn factor<'j>(&self, jacobian: MatRef<'j, f64>, scale: &[f64]) -> Box<dyn Factorization + 'j> {
///         Box::new(Column { entries: jacobian.col(0).iter().copied().collect(), scale: scale[0] })
///     }
/// }
///
/// impl Column {
///     fn dot(&self, b: &[f64]) -> f64 { self.entries.iter().zip(b).map(|(j, b)| j * b).sum() }
/// }
///
/// impl Factorization for Column {
///     fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
///         let p = -self.dot(b) / (self.dot(&self.entries) + lambda * self.scale * self.scale);
///         p.is_finite().then(|| vec![p])
///     }
///     fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> { self.damped(b, 0.0) }
///     fn tangential(&self, b: &[f64]) -> f64 {
///         self.dot(b).abs() / self.dot(&self.entries).sqrt()
///     }
/// }
///
/// let options = stillpoint_solver::Options { linear_solver: LinearSolver::own(&Single), ..Default::default() };
/// # use stillpoint_solver::{Jet, Mask, Parameters, from_fn, solve};
/// let root = from_fn(|x: &[Jet], out: &mut Vec<Jet>| out.push(x[0] * x[0] - 2.0));
/// let fit = solve(&root, &Parameters::unnamed(&[1.0]), &Mask::all(1), &options)?;
/// assert!((fit.parameters.values()[0] - 2f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub trait LinearMethod {
    /// Factors `J D⁻¹` for `J` (`m × n`) and the diagonal of `D` (`n`).
    fn factor<'j>(&self, jacobian: MatRef<'j, f64>, scale: &[f64]) -> Box<dyn Factor + 'j>;
}

/// A [`LinearMethod`] behind a reference; equal to itself only.
#[derive(Clone, Copy)]
pub struct OwnLinearSolver(&'static (dyn LinearMethod + Sync));

impl std::fmt::Debug for OwnLinearSolver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("OwnLinearSolver")
    }
}

impl PartialEq for OwnLinearSolver {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(self.0, other.0)
    }
}

impl LinearSolver {
    /// A linear solver of one's own: a constant or a `static`.
    pub fn own(method: &'static (dyn LinearMethod + Sync)) -> Self {
        Self::Own(OwnLinearSolver(method))
    }
}

/// Residuals, cost and Jacobian at one point.
#[derive(Clone, Debug)]
pub(crate) struct Linearization {
    /// `r` (`m`), corrected for the loss.
    pub residuals: Vec<f64>,
    /// What is minimised: `½ ‖r‖²`, or half the sum of the losses.
    pub cost: f64,
    /// `∂r/∂x` (`m × n`), free columns only.
    pub jacobian: Jacobian,
}

/// A dense Jacobian (`m × n`).
#[derive(Clone, Debug)]
pub(crate) struct Jacobian(pub Mat<f64>);

/// A factorisation that solves damped linear least squares for many dampings and right sides.
pub trait Factor {
    /// `argmin ‖J p + b‖² + λ ‖D p‖²`; `None` where that is not finite.
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>>;

    /// `argmin ‖J p + b‖²`, of minimum `‖D p‖` where the rank is short.
    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>>;

    /// Length of the part of `b` in the column space of `J`.
    fn tangential(&self, b: &[f64]) -> f64;
}

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

/// `A p`.
pub(crate) fn multiply(a: MatRef<'_, f64>, p: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; a.nrows()];
    for (column, &factor) in a.col_iter().zip(p).filter(|(_, p)| **p != 0.0) {
        match column.try_as_col_major() {
            Some(column) => add_to(&mut out, factor, column.as_slice()),
            None => {
                for (sum, value) in out.iter_mut().zip(column.iter()) {
                    *sum += factor * value;
                }
            }
        }
    }
    out
}

/// `Aᵀ b`.
pub(crate) fn transpose_multiply(a: MatRef<'_, f64>, b: &[f64]) -> Vec<f64> {
    a.col_iter()
        .map(|column| match column.try_as_col_major() {
            Some(column) => dot(column.as_slice(), b),
            None => column.iter().zip(b).map(|(a, b)| a * b).sum(),
        })
        .collect()
}

/// Row and column of the first entry that is not finite, column by column.
pub(crate) fn not_finite(a: &Mat<f64>) -> Option<(usize, usize)> {
    (0..a.ncols()).find_map(|k| {
        let row = a.col_as_slice(k).iter().position(|v| !v.is_finite())?;
        Some((row, k))
    })
}
