//! Errors of an accelerometer's biases that are fitted alone, beside parameters of a calibration that have errors themselves.

use nalgebra::{DMatrix, DVector, Matrix3};
use solver::scalar::{derivatives, variable};
use solver::{Jet, Residual, lit};

use super::chance;
use super::small_sample::{UNREMARKABLE, widening};
use crate::calibration::Calibration;
use crate::residuals::GravityNorm;

/// First of the three biases among the parameters of a model.
const BIASES: usize = 9;

/// Number of biases.
const BIAS_COUNT: usize = 3;

/// The covariance of the biases (`3 × 3`) by least squares of `e = |T(a - b) - …| - g` over the static intervals.
///
/// With `J_b` and `J_c` the derivatives of `e` by the biases and by the other parameters, of covariance `C`, and `W` the variances of the
/// mean readings, it is `P V Pᵀ`, `V = W + J_c C J_cᵀ`, `P = (J_bᵀ J_b)⁻¹ J_bᵀ`, enlarged where the residuals are larger than `V` lets
/// them be. The residuals alone say little of the errors: of few intervals they are small by chance. Where the calibration does not state
/// `C` they have to do, widened as Student's law asks.
///
/// `None` where the intervals do not tell the biases apart.
pub(super) fn covariance(
    problem: &GravityNorm<'_>,
    values: &[f64],
    names: &[String],
    calibration: &Calibration,
) -> Option<Matrix3<f64>> {
    let n = problem.means.len();
    let columns: Vec<_> = (0..values.len())
        .map(|k| column(problem, values, k))
        .collect();
    let jacobian = DMatrix::from_columns(&columns);
    let by_biases = jacobian.columns(BIASES, BIAS_COUNT).into_owned();
    let inverse = (by_biases.transpose() * &by_biases).cholesky()?.inverse();
    let solve = inverse * by_biases.transpose();
    // Of an axis of the mean, in the raw unit; the biases have that unit, too.
    let white = |i: usize| problem.means[i].white * by_biases.row(i).norm();
    let mut expected = DMatrix::from_diagonal(&DVector::from_fn(n, |i, _| white(i).powi(2)));
    let known = of_others(names, calibration);
    if let Some(covariance) = &known {
        expected += &jacobian * covariance * jacobian.transpose();
    }
    let mut e = Vec::new();
    Residual::<f64>::residuals(problem, values, &mut e);
    let square: f64 = e.iter().map(|e| e * e).sum();
    let freedom = n - BIAS_COUNT;
    let enlarged = match known {
        Some(_) => {
            let left = DMatrix::identity(n, n) - &by_biases * &solve;
            let larger = square / (&left * &expected).trace().max(f64::MIN_POSITIVE);
            let is_chance =
                chance::of_chi2(larger * freedom as f64, freedom as f64) > UNREMARKABLE.get();
            expected
                * match is_chance {
                    true => larger.max(1.0),
                    false => larger * widening(freedom).powi(2),
                }
        }
        None => {
            let scatter = square / freedom as f64 * widening(freedom).powi(2);
            expected + DMatrix::identity(n, n) * scatter
        }
    };
    let covariance = &solve * enlarged * solve.transpose();
    Some(
        covariance
            .fixed_view::<BIAS_COUNT, BIAS_COUNT>(0, 0)
            .into_owned(),
    )
}

/// The derivatives of the residuals by one parameter.
fn column(problem: &GravityNorm<'_>, values: &[f64], k: usize) -> DVector<f64> {
    let mut x: Vec<Jet> = values.iter().map(|v| lit(*v)).collect();
    x[k] = variable(values[k], 0);
    let mut out = Vec::new();
    problem.residuals(&x, &mut out);
    DVector::from_iterator(out.len(), out.iter().map(|e| derivatives(e)[0]))
}

/// The covariance of all parameters of a model but its biases; `None` where the calibration states none.
fn of_others(names: &[String], calibration: &Calibration) -> Option<DMatrix<f64>> {
    let is_bias = |k: usize| (BIASES..BIASES + BIAS_COUNT).contains(&k);
    let places: Vec<Option<usize>> = names
        .iter()
        .enumerate()
        .map(|(k, name)| {
            calibration
                .parameters
                .iter()
                .position(|own| own == name && !is_bias(k))
        })
        .collect();
    let covariance = DMatrix::from_fn(names.len(), names.len(), |i, j| {
        match (places[i], places[j]) {
            (Some(i), Some(j)) => calibration.covariance[i][j],
            _ => 0.0,
        }
    });
    let is_stated = places.iter().any(Option::is_some) && covariance.iter().all(|v| v.is_finite());
    is_stated.then_some(covariance)
}
