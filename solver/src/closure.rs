//! Problems from closures, for quick use.

use faer::Mat;

use crate::residual::{Problem, dual_jacobian};
use crate::scalar::Jet;

/// A problem from a closure over [`Jet`]: exact derivatives, no second derivatives.
///
/// ```
/// # use stillpoint_solver as solver;
/// use solver::{DualNum, Jet, Mask, Options, Parameters, from_fn, lit, solve};
///
/// let data = [(0.0, 2.0), (1.0, 1.213), (2.0, 0.736)];
/// let decay = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
///     out.extend(data.iter().map(|&(t, y)| x[0] * (-x[1] * t).exp() - lit::<Jet>(y)));
/// });
/// let report = solve(&decay, &Parameters::unnamed(&[1.0, 1.0]), &Mask::all(2), &Options::default())?;
/// assert!((report.parameters.values()[1] - 0.5).abs() < 1e-3);
/// # Ok::<(), solver::Error>(())
/// ```
pub fn from_fn<F: Fn(&[Jet], &mut Vec<Jet>)>(f: F) -> impl Problem {
    Dual(f)
}

/// A problem from a closure over `f64`, differentiated by central differences: some ten digits of
/// the Jacobian at twice the evaluations. For residuals that cannot be written over a [`Jet`].
pub fn from_fn_numeric<F: Fn(&[f64], &mut Vec<f64>)>(f: F) -> impl Problem {
    Numeric(f)
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

/// `(r(x + h eₖ) − r(x − h eₖ)) / 2h` with `h = ∛ε max(1, |xₖ|)` (`m × free.len()`).
pub(crate) fn central_differences(
    problem: &dyn Problem,
    x: &[f64],
    free: &[usize],
    m: usize,
) -> Mat<f64> {
    let mut jacobian = Mat::zeros(m, free.len());
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for (column, &k) in free.iter().enumerate() {
        let h = f64::EPSILON.cbrt() * x[k].abs().max(1.0);
        problem.values(&with(x, k, x[k] + h), &mut above);
        problem.values(&with(x, k, x[k] - h), &mut below);
        for row in 0..m.min(above.len()).min(below.len()) {
            jacobian[(row, column)] = (above[row] - below[row]) / (2.0 * h);
        }
    }
    jacobian
}

fn with(x: &[f64], k: usize, value: f64) -> Vec<f64> {
    let mut moved = x.to_vec();
    moved[k] = value;
    moved
}
