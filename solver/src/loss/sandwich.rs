//! The covariance that does not believe in equal variances.

use faer::Mat;

use crate::error::Error;
use crate::linear::Jacobian;
use crate::loss::robust::{Losses, Robust};
use crate::minimise::system::{Dense, System};
use crate::options::Options;
use crate::parameters::Mask;
use crate::report::Report;
use crate::residual::Problem;

/// The sandwich covariance `m / (m − p) · A⁻¹ (Σ ψᵢ² Jᵢᵀ Jᵢ) A⁻¹` of the free parameters (`n × n`, in the
/// order of `report.uncertainty.names`), with `A = Jᵀ C J`, `ψ = ρ′ r` and the curvatures `C` of the loss.
///
/// The classical covariance assumes residuals of one variance; this one takes the variance of each from
/// its own residual, and so holds where the noise grows with the signal. It needs many residuals per
/// parameter, and independent ones; where the two differ much, the noise model is wrong.
///
/// `report` is the fit of `problem` under `mask` and `options`. Zero across active constraints and, where the
/// rank is short, along what the data do not determine.
///
/// Source: White, "A heteroskedasticity-consistent covariance matrix estimator", 1980; Huber, "Robust
/// Statistics", 1981, section 6.3.
///
/// # Errors
/// A mask of another length than the parameters, and a fit without a spare residual.
///
/// # Examples
/// ```
/// use stillpoint_solver::{Jet, Mask, Options, Parameters, from_fn, sandwich_covariance, solve};
///
/// // Errors that grow with the signal.
/// let line = from_fn(|x: &[Jet], r: &mut Vec<Jet>| {
///     let y = |t: f64| t + 0.1 * t * (40.0 * t).sin();
///     r.extend((1..=200).map(|k| 0.1 * f64::from(k)).map(|t| x[0] * t - y(t)));
/// });
/// let (mask, options) = (Mask::all(1), Options::default());
/// let report = solve(&line, &Parameters::unnamed(&[0.5]), &mask, &options)?;
/// let covariance = sandwich_covariance(&line, &report, &mask, &options)?;
/// assert!(report.standard_error(0).is_some_and(|classical| covariance[0][0].sqrt() > 1.2 * classical));
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn sandwich_covariance(
    problem: &dyn Problem,
    report: &Report,
    mask: &Mask,
    options: &Options,
) -> Result<Vec<Vec<f64>>, Error> {
    if mask.len() != report.parameters.len() {
        return Err(Error::MaskLength {
            mask: mask.len(),
            parameters: report.parameters.len(),
        });
    }
    let (m, rank) = (report.residuals.len(), report.rank);
    let spare = m.checked_sub(rank).filter(|&spare| spare > 0);
    let spare = spare.ok_or(Error::NoSpareResidual { residuals: m, rank })?;
    let dense = Dense::new(problem, &report.parameters, mask);
    let mut losses = Losses::new(options.loss, &options.row_losses);
    losses.rest.1 = report.loss_scale.unwrap_or(losses.rest.1);
    for (group, scale) in losses.groups.iter_mut().zip(&report.row_loss_scales) {
        group.2 = scale.unwrap_or(group.2);
    }
    let robust = Robust {
        inner: &dense,
        losses,
    };
    let at = robust.linearize(&dense.restrict(report.parameters.values()));
    let Jacobian(jacobian) = at.jacobian;
    let n = jacobian.ncols();
    let bread = Mat::from_fn(n, n, |i, k| report.uncertainty.covariance[i][k]);
    // Rows √c J and residuals ψ / √c: their product is ψ J.
    let rows = Mat::from_fn(jacobian.nrows(), n, |i, k| {
        jacobian[(i, k)] * at.residuals[i]
    });
    let influence = rows * bread;
    let few = m as f64 / spare as f64;
    let sandwich = influence.transpose() * &influence;
    Ok((0..n)
        .map(|i| (0..n).map(|k| few * sandwich[(i, k)]).collect())
        .collect())
}
