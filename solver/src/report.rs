//! How a fit ended.

use serde::{Deserialize, Serialize};

use crate::covariance::Uncertainty;
use crate::parameters::Parameters;

/// Why the solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Termination {
    /// The residual is orthogonal to every column of the Jacobian.
    Gradient,
    /// The step no longer changes the parameters.
    Step,
    /// The cost no longer falls.
    Cost,
    /// The step limit was reached.
    IterationLimit,
    /// No step, however short, lowers the cost.
    Stalled,
}

impl Termination {
    /// Whether the fit is at a minimum.
    pub fn converged(self) -> bool {
        matches!(self, Self::Gradient | Self::Step | Self::Cost)
    }
}

/// One step of the trace.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Iteration {
    /// `½ ‖r‖²` after the step.
    pub cost: f64,
    /// Damping used.
    pub lambda: f64,
    /// Length of the scaled step.
    pub step: f64,
    /// Whether the step was taken.
    pub accepted: bool,
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The best parameters found.
    pub parameters: Parameters,
    /// `½ ‖r‖²` there.
    pub cost: f64,
    /// The residuals there.
    pub residuals: Vec<f64>,
    /// Why the solver stopped.
    pub termination: Termination,
    /// The steps.
    pub iterations: Vec<Iteration>,
    /// Number of Jacobian evaluations.
    pub jacobian_evaluations: usize,
    /// Covariance, rank and condition at the solution.
    pub uncertainty: Uncertainty,
}

impl Report {
    /// Root mean square of the residuals.
    pub fn rms(&self) -> f64 {
        (2.0 * self.cost / self.residuals.len() as f64).sqrt()
    }

    /// `‖r‖² / (m − rank)`, or `None` without a spare residual.
    pub fn reduced_chi2(&self) -> Option<f64> {
        let dof = self.residuals.len().checked_sub(self.uncertainty.rank)?;
        (dof > 0).then(|| 2.0 * self.cost / dof as f64)
    }
}
