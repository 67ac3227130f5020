//! Report of a fit.

mod display;
pub(crate) mod termination;

use serde::{Deserialize, Serialize};

use crate::constraints::ActiveConstraint;
use crate::minimise::system::Evaluations;
use crate::parameters::Parameters;
pub use crate::report::termination::Termination;
use crate::uncertainty::covariance::Uncertainty;

/// One step of the trace, taken or not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Iteration {
    /// Cost after the step; infinite where it was not evaluated.
    #[serde(with = "crate::infinite")]
    pub cost: f64,
    /// Size of the step: the damping, the trust radius or the fraction of the full step.
    pub lambda: f64,
    /// Length of the scaled step.
    #[serde(with = "crate::infinite")]
    pub step: f64,
    /// True where the step was taken.
    pub accepted: bool,
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The best parameters found.
    pub parameters: Parameters,
    /// Value of the minimised cost there: `½ ‖r‖²`, or half the sum of the losses.
    #[serde(with = "crate::infinite")]
    pub cost: f64,
    /// The residuals there, as the problem gives them.
    pub residuals: Vec<f64>,
    /// Weight of every residual under the loss: 1 where it counts in full, 0 where not at all.
    pub weights: Vec<f64>,
    /// The scale of the loss, in the unit of the residuals.
    pub loss_scale: Option<f64>,
    /// The scales of [`Options::row_losses`](crate::Options::row_losses), in their order.
    #[serde(default)]
    pub row_loss_scales: Vec<Option<f64>>,
    /// Why the solver stopped.
    pub termination: Termination,
    /// The steps tried. The last ones, judged by the gradient, are not among them: [`evaluations`](Self::evaluations)
    /// counts those too, so that it may have more Jacobians than there are steps.
    pub iterations: Vec<Iteration>,
    /// Number of Jacobian evaluations.
    pub jacobian_evaluations: usize,
    /// Number of all evaluations.
    pub evaluations: Evaluations,
    /// `‖P r‖ / ‖r‖`, where `P` projects on the columns of the Jacobian (along active constraints).
    pub relative_offset: f64,
    /// Length of the Gauss–Newton step that is left, relative to the parameters, both scaled by
    /// the column norms.
    #[serde(with = "crate::infinite")]
    pub relative_step: f64,
    /// Constraints that hold with equality.
    pub active: Vec<ActiveConstraint>,
    /// Largest amount by which a constraint is not met.
    pub infeasibility: f64,
    /// Covariance, rank and condition at the solution.
    pub uncertainty: Uncertainty,
    /// Number of parameters that the data determine: the rank of the whole Jacobian, with the
    /// blocks of a block problem, of which `uncertainty` does not speak.
    pub rank: usize,
    /// Variance that the covariance is to be multiplied by: the reduced `χ²` or, under a robust
    /// loss, what Huber's formula gives, in which outliers do not count in full. `None` without a
    /// spare residual.
    pub variance: Option<f64>,
}

impl Report {
    /// Standard error of free parameter `k` (as in `uncertainty.names`), with the noise as the
    /// residuals show it: `s √((JᵀJ)⁻¹)ₖₖ`, `s² = ‖r‖² / (m − rank)` ([`variance`](Self::variance)); `None` without a spare
    /// residual or such a parameter.
    ///
    /// | the residuals | the standard error |
    /// |---|---|
    /// | have one unknown spread | this one: in 68 of 100 repetitions the truth lies within it, in 95 within twice it |
    /// | are divided by their known spread | `uncertainty.standard_error(k, 1.0)` |
    /// | are few, `m − rank` below some 20 | this one times Student's `t` for intervals |
    /// | bend much within it | [`profile_interval`](crate::profile_interval) |
    /// | spread more where the signal is larger | [`sandwich_covariance`](crate::sandwich_covariance) |
    ///
    /// It means nothing for a parameter that [`Uncertainty::unobservable`] names, and is 0 for one held by a constraint.
    ///
    /// ```
    /// use stillpoint_solver::{Jet, Mask, Options, Parameters, from_fn, solve};
    ///
    /// // A mean: the standard error is the spread over √m.
    /// let data = [9.8, 10.1, 10.0, 10.3];
    /// let mean = from_fn(|x: &[Jet], r: &mut Vec<Jet>| r.extend(data.iter().map(|y| x[0] - *y)));
    /// let report = solve(&mean, &Parameters::unnamed(&[0.0]), &Mask::all(1), &Options::default())?;
    /// let spread = (0.13f64 / 3.0).sqrt(); // Σ (y − 10.05)² / (4 − 1)
    /// assert!((report.parameters.values()[0] - 10.05).abs() < 1e-12);
    /// assert!(report.standard_error(0).is_some_and(|error| (error - spread / 2.0).abs() < 1e-12));
    /// // Had every value been read to ±0.2:
    /// assert!((report.uncertainty.standard_error(0, 0.2) - 0.1).abs() < 1e-12);
    /// # Ok::<(), stillpoint_solver::Error>(())
    /// ```
    pub fn standard_error(&self, k: usize) -> Option<f64> {
        let sigma = self.variance?.sqrt();
        (k < self.uncertainty.names.len()).then(|| self.uncertainty.standard_error(k, sigma))
    }

    /// Root mean square of the residuals.
    pub fn rms(&self) -> f64 {
        (self.residuals.iter().map(|r| r * r).sum::<f64>() / self.residuals.len() as f64).sqrt()
    }

    /// `2 cost / (m − rank)`, or `None` without a spare residual. Under a robust loss the variance
    /// of the parameters follows from [`Report::variance`] instead.
    pub fn reduced_chi2(&self) -> Option<f64> {
        let dof = self.residuals.len().checked_sub(self.rank)?;
        (dof > 0).then(|| 2.0 * self.cost / dof as f64)
    }
}
