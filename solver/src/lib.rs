//! Nonlinear least squares `min ½ ‖r(x)‖²` over any residual; knows nothing about sensors.
//!
//! ```text
//! Residual<D> ──► Problem ──► solve(problem, Parameters, Mask, Options) ──► Report
//! (written once)  (derived)                                                 parameters, Uncertainty,
//!                                                                           Termination, trace
//! ```

mod covariance;
mod error;
mod lm;
mod parameters;
mod report;
mod residual;
pub mod scalar;

pub use covariance::{Uncertainty, uncertainty};
pub use error::Error;
pub use lm::{Options, Variant, solve};
pub use parameters::{Mask, Parameters};
pub use report::{Iteration, Report, Termination};
pub use residual::{Problem, Residual};
pub use scalar::{Jet, Jet2, LANES, Scalar, lit};
