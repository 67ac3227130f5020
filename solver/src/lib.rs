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
//! | write one in a line | [`from_fn`], [`from_fn_numeric`], [`from_fn_with_jacobian`] |
//! | take `abs`, `min`, `max`, `atan2` of a scalar | [`Elementary`] |
//! | check its derivatives, first and second | [`check_derivatives`], of a loss [`check_loss`] |
//! | hold parameters, bound, order or tie them | [`Mask`], [`Constraints`]; in graphs [`Graph::hold`], [`Graph::bound`] |
//! | resist outliers, by rows, with a loss of one's own | [`Loss`], [`RowLoss`], [`LossFunction`] |
//! | choose a variant, limit steps or time, cancel | [`Options`], [`Variant`] |
//! | write a variant or a linear solver of one's own | [`OwnVariant`], [`LinearMethod`] |
//! | compare variants, as a table and a picture | [`compare`] |
//! | start from many places | [`multi_start`], [`spread`] |
//! | solve 10⁵ small problems of one shape | [`solve_batch`] |
//! | watch the steps | [`solve_observed`], of a graph [`solve_graph_observed`] |
//! | minimise a quadratic cost over cones | [`ConeProgram`] |
//! | know what the data say | [`Uncertainty`], [`profile_interval`], [`sandwich_covariance`] |
//! | solve a graph: named blocks, manifolds, sparse, many small blocks with shared ones | [`Graph`], [`Manifold`], [`solve_graph`] |
//! | read and solve pose graphs and bundle adjustments | `pose_graph`, `bundle_adjustment`, with the features `pose-graphs`, `bundle-adjustment` |
//!
//! How a run goes: `iterate` steps from point to point by a *descent* (where to) and a *search* (how
//! far) until the residual is nearly orthogonal to the Jacobian; `finish` takes the last steps,
//! judged by the gradient, since the cost changes by less than double precision resolves; `ending` says
//! what the last point is.
//!
//! Without threads and, unless a time limit is set or variants are compared, without a clock: fit for
//! WebAssembly.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

#[cfg(feature = "bundle-adjustment")]
pub mod bundle_adjustment;
mod check;
mod clock;
mod closure;
mod compare;
mod constraints;
mod descent;
mod error;
mod feasible;
mod graph;
mod infinite;
mod linear;
mod loss;
mod many;
mod minimise;
mod options;
mod parameters;
#[cfg(feature = "pose-graphs")]
pub mod pose_graph;
mod report;
mod residual;
mod rules;
pub mod scalar;
mod search;
mod solve;
mod uncertainty;

pub use check::{Mismatch, check_derivatives};
/// A column-compressed matrix and the cones of a [`ConeProgram`].
pub use clarabel::{algebra::CscMatrix, solver::SupportedConeT};
pub use closure::{from_fn, from_fn_numeric, from_fn_with_jacobian};
pub use compare::{
    ComparedRun, Comparison, Measure, Profile, Table, compare, compare_graphs, compare_with,
    graph_variants,
};
pub use constraints::{ActiveConstraint, Constraint, Constraints};
pub use descent::{Descent, Local, Step};
pub use error::Error;
pub use faer::{Mat, MatRef};
pub use feasible::cone_program::{ConeProgram, ConeSolution};
pub use graph::{
    Block, Direction, Euclidean, Factor, Graph, GraphOptions, GraphReport, Manifold, Method,
    NullVector, PlanarMotion, Products, RigidMotion, Rotation, RotationVector, check_manifold,
    graph_profile, quaternion, solve_graph, solve_graph_observed,
};
pub use linear::{Factor as Factorization, LinearMethod, LinearSolver, OwnLinearSolver};
pub use loss::check::{LossMismatch, check_loss};
pub use loss::sandwich::sandwich_covariance;
pub use loss::{Loss, LossFunction, LossScale, OwnLoss, RowLoss};
pub use many::batch::{Batch, BatchOptions, solve_batch};
pub use many::multistart::{Minimum, MultiStart, multi_start, spread};
pub use minimise::system::Evaluations;
pub use options::{NewSearch, Options, OwnVariant, Variant};
pub use parameters::{Mask, Parameters};
pub use report::{Iteration, Report, Termination};
pub use residual::{Problem, Residual};
pub use scalar::elementary::Elementary;
pub use scalar::{DualNum, Jet, Jet2, LANES, Scalar, Wide, lit};
pub use search::{Damping, Search, Trial};
pub use solve::{solve, solve_observed};
pub use uncertainty::covariance::{Uncertainty, uncertainty};
pub use uncertainty::profile::{ProfileInterval, profile_interval};

/// The Rust blocks of the crate's README compile and hold.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
