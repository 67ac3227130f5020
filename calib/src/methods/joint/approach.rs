//! Plain Gauss–Newton steps, for the points on the way.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, MatMut, Side};
use solver::Problem;

use super::problem::{Linear, Rows};
use super::weights::Whitening;

/// Steps at most.
const STEPS: usize = 12;

/// A step whose effect on the rows is below this share of their length is the last: a hundredth of a
/// standard deviation of all parameters together.
const NEAR: f64 = 1e-6;

/// Most steps with the same Jacobian.
const CHORDS: usize = 8;

/// Relative rise of the cost that rounding explains.
const ROUNDING: f64 = 1e-9;

/// Smallest squared pivot of normal equations with unit columns that keep digits enough for a step.
const SAFE: f64 = 1e-10;

/// Rows under a whitening.
pub struct Weighted<'a> {
    /// The rows.
    pub rows: &'a Rows<'a>,
    /// Their whitening.
    pub whitening: &'a Whitening,
}

impl Problem for Weighted<'_> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let r = self.rows.residuals(x);
        let mut column = Mat::from_fn(r.len(), 1, |i, _| r[i]);
        self.whitening.apply(column.as_mut());
        out.clear();
        out.extend(column.col(0).iter());
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        let linear = self.rows.linearize(x);
        let (r, jacobian) = linear.whitened(free, |a| self.whitening.apply(a));
        *residuals = r;
        jacobian
    }

    fn second_derivative(&self, _: &[f64], _: &[f64], _: &mut Vec<f64>) -> bool {
        false
    }
}

impl Linear {
    /// Residuals and free columns after `whiten`.
    pub fn whitened(
        &self,
        free: &[usize],
        whiten: impl Fn(MatMut<'_, f64>),
    ) -> (Vec<f64>, Mat<f64>) {
        let m = self.residuals.len();
        let mut jacobian = Mat::from_fn(m, free.len(), |i, k| self.jacobian[(i, free[k])]);
        whiten(jacobian.as_mut());
        let mut residuals = Mat::from_fn(m, 1, |i, _| self.residuals[i]);
        whiten(residuals.as_mut());
        (residuals.col(0).iter().copied().collect(), jacobian)
    }

    /// The rows at `x` as they would be without its parameters from `plain` on, which are disturbances.
    pub fn without_disturbances(&self, x: &[f64], plain: usize) -> Self {
        let mut residuals = self.residuals.clone();
        for (k, value) in x.iter().enumerate().skip(plain) {
            for (r, slope) in residuals.iter_mut().zip(self.jacobian.col(k).iter()) {
                *r -= slope * value;
            }
        }
        Self {
            residuals,
            jacobian: self.jacobian.as_ref().subcols(0, plain).to_owned(),
        }
    }
}

/// Steps from `x` until they are small against the noise, with the rows there; `None` where the cost rises
/// or the normal equations are close to singular.
pub fn approach(weighted: &Weighted<'_>, x: &[f64], free: &[usize]) -> Option<Approached> {
    let mut x = x.to_vec();
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let linear = weighted.rows.linearize(&x);
        let (r, jacobian) = linear.whitened(free, |a| weighted.whitening.apply(a));
        let cost: f64 = r.iter().map(|v| v * v).sum();
        if cost.is_nan() || cost > before * (1.0 + ROUNDING) {
            return None;
        }
        let equations = Normal::new(jacobian)?;
        let (step, square) = equations.step(&r);
        if square <= NEAR * (1.0 + cost) {
            return Some(Approached {
                x,
                linear,
                equations,
            });
        }
        add(&mut x, free, &step);
        before = cost;
    }
    None
}

/// Where plain steps led.
pub struct Approached {
    /// The parameters.
    pub x: Vec<f64>,
    /// The rows there.
    pub linear: Linear,
    equations: Normal,
}

impl Approached {
    /// Goes on with the Jacobian as it is, at the price of residuals alone: each step leaves about a
    /// thousandth of the way, until rounding stops them.
    pub fn settled(&self, weighted: &Weighted<'_>, free: &[usize]) -> Vec<f64> {
        let mut x = self.x.clone();
        let mut r = Vec::new();
        let mut before = f64::INFINITY;
        for _ in 0..CHORDS {
            weighted.values(&x, &mut r);
            let (step, square) = self.equations.step(&r);
            if square.is_nan() || square > 0.1 * before {
                break;
            }
            add(&mut x, free, &step);
            before = square;
        }
        x
    }
}

fn add(x: &mut [f64], free: &[usize], step: &[f64]) {
    for (&place, step) in free.iter().zip(step) {
        x[place] += step;
    }
}

/// Normal equations with unit columns.
struct Normal {
    jacobian: Mat<f64>,
    norms: Vec<f64>,
    factor: Llt<f64>,
}

impl Normal {
    /// `None` close to singular.
    fn new(mut jacobian: Mat<f64>) -> Option<Self> {
        let norms: Vec<f64> = jacobian.col_iter().map(|c| c.norm_l2()).collect();
        for (column, norm) in jacobian.col_iter_mut().zip(&norms) {
            column.iter_mut().for_each(|v| *v /= norm);
        }
        let factor = (jacobian.transpose() * &jacobian).llt(Side::Lower).ok()?;
        let pivots = (0..norms.len()).map(|k| factor.L()[(k, k)].powi(2));
        let least = pivots.fold(f64::INFINITY, f64::min);
        (least >= SAFE).then_some(Self {
            jacobian,
            norms,
            factor,
        })
    }

    /// The Gauss–Newton step `p` for residuals `r`, and `‖J p‖²`.
    fn step(&self, r: &[f64]) -> (Vec<f64>, f64) {
        let r = Mat::from_fn(r.len(), 1, |i, _| -r[i]);
        let right = self.jacobian.transpose() * &r;
        let scaled = self.factor.solve(&right);
        let square = (scaled.transpose() * &right)[(0, 0)];
        let scaled = scaled.col(0).iter().zip(&self.norms);
        (scaled.map(|(s, n)| s / n).collect(), square)
    }
}
