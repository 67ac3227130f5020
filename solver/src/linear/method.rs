//! Choice of a method for the damped linear problem.

use faer::MatRef;
use serde::{Deserialize, Serialize};

use super::factor::Factor;

/// Method by which the damped linear problem is solved.
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
pub struct OwnLinearSolver(pub(super) &'static (dyn LinearMethod + Sync));

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
