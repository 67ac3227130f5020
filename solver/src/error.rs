//! What can be wrong with a problem.

/// A problem that cannot be solved as it stands. A fit that stopped early is not an error: see
/// [`Termination`](crate::Termination).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A residual is not finite at the start.
    #[error(
        "residual {row} is {value} at the start: check the start values and the data of that row"
    )]
    NotFinite {
        /// Row of the residual.
        row: usize,
        /// What it was.
        value: f64,
    },
    /// A Jacobian entry is not finite at the start.
    #[error("the derivative of residual {row} by {parameter} is not finite at the start")]
    DerivativeNotFinite {
        /// Row of the residual.
        row: usize,
        /// Name of the parameter.
        parameter: String,
    },
    /// Nothing to fit, or nothing to fit it to.
    #[error("empty problem: {residuals} residuals, {free} free parameters")]
    Empty {
        /// Number of residuals.
        residuals: usize,
        /// Number of free parameters.
        free: usize,
    },
    /// The mask and the parameters disagree in length.
    #[error("mask of {mask} for {parameters} parameters")]
    MaskLength {
        /// Length of the mask.
        mask: usize,
        /// Number of parameters.
        parameters: usize,
    },
}
