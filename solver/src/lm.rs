//! Levenberg–Marquardt: linearise, step, accept or reject.

use faer::{Mat, linalg::solvers::SolveLstsq};

use crate::covariance::uncertainty;
use crate::error::Error;
use crate::parameters::{Mask, Parameters};
use crate::report::{Iteration, Report, Termination};
use crate::residual::Problem;

/// How the step is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Variant {
    /// Damped steps.
    #[default]
    LevenbergMarquardt,
    /// Undamped steps of minimum norm.
    GaussNewton,
}

/// When to stop.
#[derive(Clone, Debug)]
pub struct Options {
    /// How the step is found.
    pub variant: Variant,
    /// Most steps tried.
    pub max_iterations: usize,
    /// Largest cosine between the residual and a column of the Jacobian at a minimum.
    pub gradient_tolerance: f64,
    /// Smallest step relative to the parameters, in scaled units.
    pub step_tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            variant: Variant::default(),
            max_iterations: 200,
            gradient_tolerance: 1e-14,
            step_tolerance: 1e-15,
        }
    }
}

/// Minimises `½ ‖r(x)‖²` over the free parameters.
///
/// # Errors
/// A start at which the residual or its derivative is not finite, and an empty problem.
pub fn solve(
    problem: &dyn Problem,
    start: &Parameters,
    mask: &Mask,
    options: &Options,
) -> Result<Report, Error> {
    if mask.len() != start.len() {
        return Err(Error::MaskLength { mask: mask.len(), parameters: start.len() });
    }
    let free = mask.free_indices();
    let mut x = start.values().to_vec();
    let mut residuals = Vec::new();
    let mut jacobian = problem.linearize(&x, &free, &mut residuals);
    check(&residuals, &jacobian, &free, start)?;
    let mut evaluations = 1;
    let mut cost = half_square(&residuals);
    let mut lambda = 1e-3;
    let mut scale = vec![0.0f64; free.len()];
    let mut iterations = Vec::new();
    let mut trial = Vec::new();
    let mut termination = Termination::IterationLimit;
    for _ in 0..options.max_iterations {
        for (k, s) in scale.iter_mut().enumerate() {
            *s = s.max(jacobian.col(k).norm_l2());
        }
        if cosine(&jacobian, &residuals) <= options.gradient_tolerance {
            termination = Termination::Gradient;
            break;
        }
        let step = match options.variant {
            Variant::LevenbergMarquardt => damped_step(&jacobian, &residuals, &scale, lambda),
            Variant::GaussNewton => minimum_norm_step(&jacobian, &residuals),
        };
        let length = step.iter().zip(&scale).map(|(p, s)| (p * s).powi(2)).sum::<f64>().sqrt();
        let size = free.iter().zip(&scale).map(|(&k, s)| (x[k] * s).powi(2)).sum::<f64>().sqrt();
        let mut candidate = x.clone();
        for (&k, p) in free.iter().zip(&step) {
            candidate[k] += p;
        }
        problem.values(&candidate, &mut trial);
        let trial_cost = half_square(&trial);
        let accepted = trial_cost < cost;
        iterations.push(Iteration { cost: trial_cost, lambda, step: length, accepted });
        if accepted {
            let fall = cost - trial_cost;
            x = candidate;
            jacobian = problem.linearize(&x, &free, &mut residuals);
            evaluations += 1;
            cost = trial_cost;
            lambda = (lambda * 0.1).max(1e-20);
            if fall <= 1e-16 * cost {
                termination = Termination::Cost;
                break;
            }
        } else if length <= options.step_tolerance * size {
            termination = Termination::Step;
            break;
        } else {
            lambda *= 10.0;
            if lambda > 1e16 {
                termination = Termination::Stalled;
                break;
            }
        }
    }
    let names = free.iter().map(|&k| start.names()[k].clone()).collect();
    let mut parameters = start.clone();
    parameters.values_mut().copy_from_slice(&x);
    Ok(Report {
        parameters,
        cost,
        residuals,
        termination,
        iterations,
        jacobian_evaluations: evaluations,
        uncertainty: uncertainty(&jacobian, names),
    })
}

fn half_square(r: &[f64]) -> f64 {
    let sum = 0.5 * r.iter().map(|v| v * v).sum::<f64>();
    if sum.is_finite() { sum } else { f64::INFINITY }
}

/// Largest cosine of the angle between the residual and a column.
fn cosine(jacobian: &Mat<f64>, r: &[f64]) -> f64 {
    let norm = r.iter().map(|v| v * v).sum::<f64>().sqrt();
    (0..jacobian.ncols())
        .map(|k| {
            let dot: f64 = r.iter().enumerate().map(|(i, v)| jacobian[(i, k)] * v).sum();
            let size = jacobian.col(k).norm_l2() * norm;
            if size > 0.0 { dot.abs() / size } else { 0.0 }
        })
        .fold(0.0, f64::max)
}

/// Minimises `‖J p + r‖² + λ ‖D p‖²` by QR of the stacked matrix.
fn damped_step(jacobian: &Mat<f64>, r: &[f64], scale: &[f64], lambda: f64) -> Vec<f64> {
    let (m, n) = (jacobian.nrows(), jacobian.ncols());
    let root = lambda.sqrt();
    let unit = |k: usize| if scale[k] > 0.0 { scale[k] } else { 1.0 };
    let stacked = Mat::from_fn(m + n, n, |i, k| {
        if i < m {
            jacobian[(i, k)] / unit(k)
        } else if i - m == k {
            root
        } else {
            0.0
        }
    });
    let rhs = Mat::from_fn(m + n, 1, |i, _| if i < m { -r[i] } else { 0.0 });
    let solution = stacked.col_piv_qr().solve_lstsq(&rhs);
    (0..n).map(|k| solution[(k, 0)] / unit(k)).collect()
}

fn minimum_norm_step(jacobian: &Mat<f64>, r: &[f64]) -> Vec<f64> {
    let n = jacobian.ncols();
    let Ok(svd) = jacobian.thin_svd() else { return vec![0.0; n] };
    let s: Vec<f64> = svd.S().column_vector().iter().copied().collect();
    let mut step = vec![0.0; n];
    for k in 0..s.len() {
        if s[k] > 1e-10 * s[0] {
            let dot: f64 = r.iter().enumerate().map(|(i, v)| svd.U()[(i, k)] * v).sum();
            for (i, p) in step.iter_mut().enumerate() {
                *p -= svd.V()[(i, k)] * dot / s[k];
            }
        }
    }
    step
}

fn check(r: &[f64], jacobian: &Mat<f64>, free: &[usize], start: &Parameters) -> Result<(), Error> {
    if r.is_empty() || free.is_empty() {
        return Err(Error::Empty { residuals: r.len(), free: free.len() });
    }
    if let Some(row) = r.iter().position(|v| !v.is_finite()) {
        return Err(Error::NotFinite { row, value: r[row] });
    }
    for (column, &k) in free.iter().enumerate() {
        if let Some(row) = (0..r.len()).find(|&i| !jacobian[(i, column)].is_finite()) {
            return Err(Error::DerivativeNotFinite { row, parameter: start.names()[k].clone() });
        }
    }
    Ok(())
}
