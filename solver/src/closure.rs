//! Problems from closures, for quick use.

use faer::Mat;

use crate::linear::vector::{add, norm};
use crate::residual::{Problem, dual_jacobian};
use crate::scalar::Jet;

/// A problem from a closure over [`Jet`]: exact derivatives, no second derivatives.
///
/// A plain number stands on the right of a [`Jet`] (`x[0] * 2.0`) or is made one by [`lit`](crate::lit): `y - model` does not
/// compile, `model - y` and `lit::<Jet>(y) - model` do. Import [`DualNum`](crate::DualNum) for `exp`, `sqrt` and their like: without
/// it the compiler proposes traits that drop the derivatives ([`check_derivatives`](crate::check_derivatives) finds that).
///
/// ```
/// use stillpoint_solver::{DualNum, Jet, Mask, Options, Parameters, from_fn, lit, solve};
///
/// let data = [(0.0, 2.0), (1.0, 1.213), (2.0, 0.736)];
/// let decay = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
///     out.extend(data.iter().map(|&(t, y)| x[0] * (-x[1] * t).exp() - lit::<Jet>(y)));
/// });
/// let report = solve(&decay, &Parameters::unnamed(&[1.0, 1.0]), &Mask::all(2), &Options::default())?;
/// assert!((report.parameters.values()[1] - 0.5).abs() < 1e-3);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn from_fn<F: Fn(&[Jet], &mut Vec<Jet>)>(f: F) -> impl Problem {
    Dual(f)
}

/// A problem from a closure over `f64`, differentiated by central differences: some ten digits of
/// the Jacobian at twice the evaluations. For residuals that cannot be written over a [`Jet`].
///
/// ```
/// use stillpoint_solver::{Mask, Options, Parameters, from_fn_numeric, solve};
///
/// let valley = from_fn_numeric(|x: &[f64], r: &mut Vec<f64>| r.extend([10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]));
/// let fit = solve(&valley, &Parameters::unnamed(&[-1.2, 1.0]), &Mask::all(2), &Options::default())?;
/// assert!((fit.parameters.values()[1] - 1.0).abs() < 1e-6);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn from_fn_numeric<F: Fn(&[f64], &mut Vec<f64>)>(f: F) -> impl Problem {
    Numeric(f)
}

/// A problem from its residuals and its Jacobian: `jacobian` appends the derivatives of all residuals by all
/// parameters, row by row (`m · n` numbers, the `n` of the first residual first).
///
/// ```
/// use stillpoint_solver::{Mask, Options, Parameters, from_fn_with_jacobian, solve};
///
/// let valley = from_fn_with_jacobian(
///     |x, r| r.extend([10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]),
///     |x, j| j.extend([-20.0 * x[0], 10.0, -1.0, 0.0]),
/// );
/// let fit = solve(&valley, &Parameters::unnamed(&[-1.2, 1.0]), &Mask::all(2), &Options::default())?;
/// assert!((fit.parameters.values()[1] - 1.0).abs() < 1e-12);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn from_fn_with_jacobian<R, J>(residuals: R, jacobian: J) -> impl Problem
where
    R: Fn(&[f64], &mut Vec<f64>),
    J: Fn(&[f64], &mut Vec<f64>),
{
    Analytic {
        residuals,
        jacobian,
    }
}

struct Analytic<R, J> {
    residuals: R,
    jacobian: J,
}

impl<R: Fn(&[f64], &mut Vec<f64>), J: Fn(&[f64], &mut Vec<f64>)> Problem for Analytic<R, J> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        (self.residuals)(x, out);
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        self.values(x, residuals);
        let (m, n) = (residuals.len(), x.len());
        let mut rows = Vec::with_capacity(m * n);
        (self.jacobian)(x, &mut rows);
        if rows.len() != m * n {
            // Of a wrong length: refused as a matrix of another shape is.
            return Mat::zeros(0, 0);
        }
        Mat::from_fn(m, free.len(), |i, k| rows[i * n + free[k]])
    }
}

struct Dual<F>(F);

struct Numeric<F>(F);

impl<F: Fn(&[Jet], &mut Vec<Jet>)> Problem for Dual<F> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let point: Vec<Jet> = x.iter().map(|&x| Jet::from(x)).collect();
        let mut rows = Vec::new();
        (self.0)(&point, &mut rows);
        out.clear();
        out.extend(rows.iter().map(|row| row.re));
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        dual_jacobian(&self.0, x, free, residuals)
    }

    fn second_derivative(&self, _: &[f64], _: &[f64], _: &mut Vec<f64>) -> bool {
        false
    }
}

impl<F: Fn(&[f64], &mut Vec<f64>)> Problem for Numeric<F> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        (self.0)(x, out);
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        self.values(x, residuals);
        central_differences(self, x, free, residuals.len())
    }

    fn second_derivative(&self, _: &[f64], _: &[f64], _: &mut Vec<f64>) -> bool {
        false
    }
}

/// Relative step of a central difference, `∛ε`: where truncation and rounding weigh the same.
const STEP: f64 = 6.055_454_452_393_343e-6;

/// Change of the residuals, relative to them, that rounding leaves no digits of.
const UNRESOLVED: f64 = 1e-10;

/// `(r(x + h eₖ) − r(x − h eₖ)) / 2h` with `h = ∛ε |xₖ|` (`m × free.len()`), so that it does not
/// depend on the units; with `h = ∛ε max(1, |xₖ|)` where that changes too little. Where one side is
/// not finite, as next to a logarithm's zero, from the other: `(4 r(x + h) − 3 r(x) − r(x + 2h)) / 2h`.
pub(crate) fn central_differences(
    problem: &dyn Problem,
    x: &[f64],
    free: &[usize],
    m: usize,
) -> Mat<f64> {
    let mut jacobian = Mat::zeros(m, free.len());
    for (column, &k) in free.iter().enumerate() {
        let (near, far) = (STEP * x[k].abs(), STEP * x[k].abs().max(1.0));
        let differences = Some(near)
            .filter(|h| *h > 0.0)
            .and_then(|h| column_differences(problem, x, k, h, true))
            .or_else(|| column_differences(problem, x, k, far, false))
            .or_else(|| column_differences(problem, x, k, near, false))
            .unwrap_or_else(|| vec![f64::NAN; m]);
        for (row, value) in differences.into_iter().take(m).enumerate() {
            jacobian[(row, column)] = value;
        }
    }
    jacobian
}

/// The differences by parameter `k` with step `h`; `None` where they are not finite or, if asked to
/// be `resolved`, next to nothing.
fn column_differences(
    problem: &dyn Problem,
    x: &[f64],
    k: usize,
    h: f64,
    resolved: bool,
) -> Option<Vec<f64>> {
    let at = |steps: f64| {
        let mut moved = x.to_vec();
        moved[k] += steps * h;
        let mut out = Vec::new();
        problem.values(&moved, &mut out);
        out.iter().all(|v| v.is_finite()).then_some(out)
    };
    let one_sided = |side: f64| {
        let (here, near, far) = (at(0.0)?, at(side)?, at(2.0 * side)?);
        let each = here.iter().zip(&near).zip(&far);
        let slope = |((here, near), far): ((&f64, &f64), &f64)| 4.0 * near - 3.0 * here - far;
        Some(each.map(|v| side * slope(v)).collect::<Vec<f64>>())
    };
    let twice = match (at(1.0), at(-1.0)) {
        (Some(above), Some(below)) => {
            let change = add(&above, -1.0, &below);
            if resolved && norm(&change) <= UNRESOLVED * norm(&above) {
                return None;
            }
            change
        }
        (Some(_), None) => one_sided(1.0)?,
        (None, Some(_)) => one_sided(-1.0)?,
        (None, None) => return None,
    };
    Some(twice.iter().map(|v| v / (2.0 * h)).collect())
}
