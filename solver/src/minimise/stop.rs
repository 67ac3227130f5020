//! Why the loop of a minimisation was left.

use crate::minimise::point::NotFinite;

/// Why the loop was left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stop {
    /// The residual is nearly orthogonal to the columns of the Jacobian.
    Near,
    /// The step no longer changes the parameters.
    Step,
    /// The cost no longer falls.
    Flat,
    /// The step limit.
    IterationLimit,
    /// The time limit.
    TimeLimit,
    /// The user.
    Cancelled,
    /// The residuals are zero, to rounding.
    Zero,
    /// No step leads down.
    Stalled,
    /// Every step leads to where the problem is not finite.
    NotFinite(NotFinite),
}
