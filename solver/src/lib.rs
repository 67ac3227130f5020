//! Nonlinear least squares `min ½ ‖r(x)‖²` over any residual; knows nothing about sensors.
//!
//! ```text
//! Residual<D> ──► Problem ──► solve(problem, Parameters, Mask, Options) ──► Report
//! (written once)  (derived)                                                 parameters, Uncertainty,
//!                                                                           Termination, trace
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod blocks;
mod check;
mod closure;
mod constraints;
mod covariance;
mod descent;
mod error;
mod feasible;
mod finish;
mod infinite;
mod iterate;
mod linear;
mod loss;
mod newton;
mod observability;
mod options;
mod parameters;
mod point;
mod profile;
mod report;
mod residual;
pub mod scalar;
mod scaling;
mod search;
mod solve;
mod system;
mod vector;

pub use blocks::{BlockProblem, BlockReport, solve_blocks};
pub use check::{Mismatch, check_derivatives};
pub use closure::{from_fn, from_fn_numeric};
pub use constraints::{ActiveConstraint, Constraint, Constraints};
pub use covariance::{Uncertainty, uncertainty};
pub use error::Error;
pub use linear::LinearSolver;
pub use loss::{Loss, LossScale};
pub use options::{Damping, Options, Variant};
pub use parameters::{Mask, Parameters};
pub use profile::{ProfileInterval, profile_interval};
pub use report::{Iteration, Report, Termination};
pub use residual::{Problem, Residual};
pub use scalar::{DualNum, Jet, Jet2, LANES, Scalar, lit};
pub use solve::{solve, solve_observed};
pub use system::Evaluations;

/// The Rust block of the project's README compiles and holds.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
