//! Nonlinear least squares `min ½ ‖r(x)‖²` over any residual; knows nothing about sensors.
//!
//! ```text
//! Residual<D> ──► Problem ──► solve(problem, Parameters, Mask, Options) ──► Report
//! (written once)  (derived)                                                 parameters, Uncertainty,
//!                                                                           Termination, trace
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod covariance;
mod descent;
mod error;
mod finish;
mod iterate;
mod linear;
mod options;
mod parameters;
mod point;
mod report;
mod residual;
pub mod scalar;
mod scaling;
mod search;
mod solve;
mod system;
mod vector;

pub use covariance::{Uncertainty, uncertainty};
pub use error::Error;
pub use linear::LinearSolver;
pub use options::{Damping, Options, Variant};
pub use parameters::{Mask, Parameters};
pub use report::{Iteration, Report, Termination};
pub use residual::{Problem, Residual};
pub use scalar::{Jet, Jet2, LANES, Scalar, lit};
pub use solve::solve;
