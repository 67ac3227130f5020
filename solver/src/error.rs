//! Errors of a problem.

use crate::report::termination::Termination;

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
        /// Its value.
        value: f64,
    },
    /// A Jacobian entry is not finite at the start, or the Jacobian has not the shape of residuals
    /// by free parameters.
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
    /// A name that no parameter has.
    #[error("no parameter is called {name}")]
    UnknownParameter {
        /// The name.
        name: String,
    },
    /// Limits that no value fits between, or that are not numbers.
    #[error("constraint {constraint}: nothing lies between {lower} and {upper}")]
    EmptyRange {
        /// The constraint in words.
        constraint: String,
        /// Its lower limit.
        lower: f64,
        /// Its upper limit.
        upper: f64,
    },
    /// The start lies outside a constraint.
    #[error(
        "constraint {constraint} is {value} at the start, outside {lower} to {upper}: see Constraints::project, or Graph::move_within_bounds"
    )]
    StartInfeasible {
        /// The constraint in words.
        constraint: String,
        /// Its value at the start.
        value: f64,
        /// Its lower limit.
        lower: f64,
        /// Its upper limit.
        upper: f64,
    },
    /// A variant that does not do what is asked.
    #[error("{variant} does not support {what}")]
    Unsupported {
        /// The variant.
        variant: String,
        /// The ability it lacks.
        what: &'static str,
    },
    /// A scale of a loss that is not a positive number, or whose square is not.
    #[error("scale of the loss is {value:e}, must be positive and neither huge nor tiny")]
    LossScale {
        /// The scale.
        value: f64,
    },
    /// A loss of one's own that does not count small residuals by their square.
    #[error(
        "the loss has ρ(0) = {value} and ρ′(0) = {slope}, must have 0 and 1: divide ρ, ρ′ and ρ″ by {slope}"
    )]
    LossShape {
        /// `ρ(0)`.
        value: f64,
        /// `ρ′(0)`.
        slope: f64,
    },
    /// A loss of one's own that falls somewhere.
    #[error(
        "the loss has ρ′({s:e}) = {slope:e}, must be 0 or more: check its derivatives (check_loss)"
    )]
    LossSlope {
        /// Squared residual over squared scale.
        s: f64,
        /// `ρ′(s)`.
        slope: f64,
    },
    /// A profile interval of a size that is not a positive number.
    #[error("a profile interval of {z} standard errors: must be positive")]
    ProfileLevel {
        /// The size asked for.
        z: f64,
    },
    /// A fit without a spare residual, whose noise nothing tells.
    #[error("{residuals} residuals for rank {rank}: no spare residual to tell the noise by")]
    NoSpareResidual {
        /// Number of residuals.
        residuals: usize,
        /// Rank of the Jacobian.
        rank: usize,
    },
    /// A refit for a profile interval that was stopped before its minimum.
    #[error("a refit of the profile ended early: {termination}")]
    Refit {
        /// Why.
        termination: Termination,
    },
    /// A factor that speaks of a block that is not there.
    #[error("a factor speaks of block {block}, there are {blocks}")]
    UnknownBlock {
        /// Number of the block, from 0.
        block: usize,
        /// Number of blocks.
        blocks: usize,
    },
    /// A block of a graph whose start has not the length that its manifold stores, or is not finite.
    #[error("block {block} starts with {found} values, {numbers} finite ones needed")]
    BlockStart {
        /// Name of the block.
        block: String,
        /// Number of values given.
        found: usize,
        /// Number that the manifold stores.
        numbers: usize,
    },
    /// A block of a graph whose name another one has.
    #[error("two blocks are called {block}: give every block a name of its own")]
    RepeatedName {
        /// The name.
        block: String,
    },
    /// A factor that reads a block twice.
    #[error("factor {factor} reads block {block} twice: add it once")]
    RepeatedBlock {
        /// Number of the factor, from 0.
        factor: usize,
        /// Name of the block.
        block: String,
    },
    /// A factor whose residuals or Jacobian have not the length they had.
    #[error("factor {factor}: {found} entries of its residuals or Jacobian, {expected} expected")]
    FactorLength {
        /// Number of the factor, from 0.
        factor: usize,
        /// Their number.
        found: usize,
        /// Number that there should be.
        expected: usize,
    },
    /// A factorisation that needs more memory, or longer indices, than there are.
    #[error("the factorisation of the graph is too large: {unknowns} unknowns")]
    TooLarge {
        /// Number of free coordinates.
        unknowns: usize,
    },
}
