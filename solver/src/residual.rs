//! Residuals of the minimised cost `½ ‖r(x)‖²`, written once over any scalar.

use faer::Mat;

use crate::scalar::{Jet, Jet2, LANES, Scalar, along, derivatives, second_derivative, variable};

/// A residual vector `r(x)` (length `m`) of parameters `x` (length `n`), over any scalar.
///
/// Implement it generically, `impl<D: Scalar> Residual<D> for Mine`; the [`Problem`] that the
/// solver works on follows from it.
pub trait Residual<D: Scalar> {
    /// Appends the `m` residuals at `x` to `out`, which arrives empty; as many at every `x`.
    fn residuals(&self, x: &[D], out: &mut Vec<D>);
}

/// Questions of the solver to a residual: values, and derivatives for the free columns only.
///
/// Derived for every [`Residual`]; implement it by hand where the Jacobian has a faster form than
/// dual numbers through the whole computation.
pub trait Problem {
    /// Replaces `out` by the residuals at `x`.
    fn values(&self, x: &[f64], out: &mut Vec<f64>);

    /// Replaces `residuals` by those at `x` and returns `∂r/∂x` (`m × free.len()`) for the
    /// parameters listed in `free`. A parameter that is not listed costs nothing. The number of
    /// residuals is the same at every `x`; a matrix of another shape counts as not finite.
    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64>;

    /// Replaces `out` by `d²/dt² r(x + t·v)` at `t = 0` and returns `true`; returns `false` where
    /// the problem has no second derivatives to offer, as it does by itself.
    fn second_derivative(&self, x: &[f64], v: &[f64], out: &mut Vec<f64>) -> bool {
        let _ = (x, v, out);
        false
    }
}

impl<R> Problem for R
where
    R: Residual<f64> + Residual<Jet> + Residual<Jet2>,
{
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        Residual::<f64>::residuals(self, x, out);
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        let evaluate = |x: &[Jet], out: &mut Vec<Jet>| Residual::<Jet>::residuals(self, x, out);
        dual_jacobian(&evaluate, x, free, residuals)
    }

    fn second_derivative(&self, x: &[f64], v: &[f64], out: &mut Vec<f64>) -> bool {
        let point: Vec<Jet2> = x.iter().zip(v).map(|(&x, &v)| along(x, v)).collect();
        let mut rows = Vec::with_capacity(out.capacity());
        Residual::<Jet2>::residuals(self, &point, &mut rows);
        out.clear();
        out.extend(rows.iter().map(second_derivative));
        true
    }
}

/// A Jacobian (`m × n`) as it is where its shape is right, without a finite entry elsewhere.
pub(crate) fn of_shape(jacobian: Mat<f64>, m: usize, n: usize) -> Mat<f64> {
    if jacobian.shape() == (m, n) {
        jacobian
    } else {
        Mat::from_fn(m, n, |_, _| f64::NAN)
    }
}

/// The Jacobian (`m × free.len()`) by forward mode, [`LANES`] columns per pass; `residuals` become
/// the values of the first pass.
pub(crate) fn dual_jacobian(
    evaluate: &impl Fn(&[Jet], &mut Vec<Jet>),
    x: &[f64],
    free: &[usize],
    residuals: &mut Vec<f64>,
) -> Mat<f64> {
    let mut point: Vec<Jet> = x.iter().map(|&value| Jet::from_re(value)).collect();
    let mut rows = Vec::with_capacity(residuals.capacity());
    let mut jacobian = Mat::zeros(0, 0);
    for pass in 0..free.len().div_ceil(LANES).max(1) {
        let first = pass * LANES;
        let columns = &free[first..free.len().min(first + LANES)];
        for (lane, &k) in columns.iter().enumerate() {
            point[k] = variable(x[k], lane);
        }
        rows.clear();
        evaluate(&point, &mut rows);
        if pass == 0 {
            residuals.clear();
            residuals.extend(rows.iter().map(|row| row.re));
            jacobian = Mat::zeros(rows.len(), free.len());
        }
        for lane in 0..columns.len() {
            let column = jacobian.col_as_slice_mut(first + lane);
            for (slope, value) in column.iter_mut().zip(&rows) {
                *slope = derivatives(value)[lane];
            }
        }
        for &k in columns {
            point[k] = Jet::from_re(x[k]);
        }
    }
    jacobian
}
