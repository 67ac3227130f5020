//! Why a fit ended.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Why the solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Termination {
    /// The residual is orthogonal to every column of the Jacobian.
    Gradient,
    /// The step no longer changes the parameters.
    Step,
    /// The fall of the cost that the linear model promises is below the rounding of the cost.
    Cost,
    /// The residuals are zero to the rounding of the parameters, where directions mean nothing.
    Zero,
    /// A stationary point with a direction of negative curvature that leads nowhere lower.
    Saddle,
    /// The loss takes fewer residuals into account than there are parameters: no minimum of anything.
    Weightless,
    /// The step limit was reached.
    IterationLimit,
    /// The time limit was reached.
    TimeLimit,
    /// The callback or the cancellation flag asked to stop.
    Cancelled,
    /// No step, however short, lowers the cost, and yet the residual is not orthogonal to the
    /// Jacobian: a derivative that does not belong to its residual, a kink, or rounding.
    Stalled,
    /// However short the step, the problem is not finite after it.
    NotFinite {
        /// Row of the residual.
        row: usize,
        /// Free parameter whose derivative it is, an index into `uncertainty.names`; `None` if the
        /// residual itself is not finite.
        parameter: Option<usize>,
    },
}

impl fmt::Display for Termination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gradient => write!(f, "converged: the residual is orthogonal to the Jacobian"),
            Self::Step => write!(
                f,
                "converged: the Gauss-Newton step no longer changes the parameters"
            ),
            Self::Cost => write!(
                f,
                "converged: the linear model promises less than rounding of the cost"
            ),
            Self::Zero => write!(f, "converged: the residuals are zero to rounding"),
            Self::Saddle => write!(f, "stalled: at a saddle; start elsewhere"),
            Self::Weightless => write!(
                f,
                "stalled: the loss gives weight to fewer residuals than there are parameters; \
                 take a larger scale or a start nearer the solution"
            ),
            Self::IterationLimit => write!(f, "stopped: step limit"),
            Self::TimeLimit => write!(f, "stopped: time limit"),
            Self::Cancelled => write!(f, "stopped: cancelled"),
            Self::Stalled => write!(
                f,
                "stalled: no step lowers the cost though the gradient is not zero; \
                 check the derivatives and look for kinks"
            ),
            Self::NotFinite {
                row,
                parameter: None,
            } => {
                write!(
                    f,
                    "stalled: residual {row} is not finite after every step tried"
                )
            }
            Self::NotFinite {
                row,
                parameter: Some(k),
            } => write!(
                f,
                "stalled: the derivative of residual {row} by free parameter {k} is not finite after every step tried"
            ),
        }
    }
}

impl Termination {
    /// True where the fit is at a minimum.
    pub fn converged(self) -> bool {
        matches!(self, Self::Gradient | Self::Step | Self::Cost | Self::Zero)
    }
}
