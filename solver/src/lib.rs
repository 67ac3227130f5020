//! Nonlinear least squares `min ½ ‖r(x)‖²` over any residual; knows nothing about sensors.
//!
//! ```text
//! Residual<D> ──► Problem ──► solve(problem, Parameters, Mask, Options) ──► Report
//! (written once)  (derived)                                                 parameters, Uncertainty,
//!                                                                           Termination, trace
//! ```
//!
//! | to … | see |
//! |---|---|
//! | write a problem once over any scalar | [`Residual`] |
//! | write one in a line | [`from_fn`], [`from_fn_numeric`] |
//! | check its derivatives | [`check_derivatives`] |
//! | hold parameters, bound, order or tie them | [`Mask`], [`Constraints`] |
//! | resist outliers | [`Loss`] |
//! | choose a variant, limit steps or time, cancel | [`Options`] |
//! | watch the steps | [`solve_observed`] |
//! | know what the data say | [`Uncertainty`], [`profile_interval`] |
//! | solve a graph: named blocks, manifolds, sparse | [`Graph`], [`Manifold`], [`solve_graph`] |
//! | fit many small blocks with shared parameters | [`BlockProblem`] |
//!
//! How a run goes: `iterate` steps from point to point by a *descent* (where to) and a *search* (how
//! far) until the residual is nearly orthogonal to the Jacobian; `finish` takes the last steps,
//! judged by the gradient, since the cost changes by less than double precision resolves.

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
mod graph;
mod infinite;
mod iterate;
mod linear;
mod loss;
mod minimise;
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
pub use graph::{
    Block, Direction, Euclidean, Factor, Graph, GraphOptions, GraphReport, Manifold, Method,
    NullVector, PlanarMotion, Products, RigidMotion, Rotation, check_manifold, quaternion,
    solve_graph,
};
pub use linear::LinearSolver;
pub use loss::{Loss, LossScale};
pub use options::{Damping, Options, Variant};
pub use parameters::{Mask, Parameters};
pub use profile::{ProfileInterval, profile_interval};
pub use report::{Iteration, Report, Termination};
pub use residual::{Problem, Residual};
pub use scalar::{DualNum, Jet, Jet2, LANES, Scalar, Wide, lit};
pub use solve::{solve, solve_observed};
pub use system::Evaluations;

/// The Rust block of the project's README compiles and holds.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
