//! Problems of named blocks of variables and factors over a few of them.
//!
//! ```text
//! Residual<D> ──► Factor ┐
//! Manifold ─────► Block ─┴► Graph ──► solve_graph ──► GraphReport
//! ```
//! How a step is found: `normal` adds up `H = JᵀJ` and `g = Jᵀr` block by block; `eliminate` takes
//! small blocks out one by one; `reduced` factors what is left: dense, sparse, or, of little fill, by
//! `block_cholesky`. Where numbers have bounds, `bounds` finds those that hold.

mod bounds;
mod culprit;
mod damping;
mod elimination;
mod evaluate;
mod factor;
mod graduated;
mod last_steps;
mod offset;
mod options;
mod problem;
mod ranges;
mod report;
mod reweight;
mod solve;
mod stage;
mod uncertainty;
mod variables;

pub use elimination::Method;
pub use factor::Factor;
pub use options::{GraphOptions, GraphReport};
pub use problem::{Block, Graph};
pub use solve::{solve_graph, solve_graph_observed};
pub use uncertainty::Products;
pub use uncertainty::null_space::NullVector;
pub use uncertainty::profile::graph_profile;
pub use variables::manifold::{Euclidean, Manifold, check_manifold};
#[cfg(feature = "pose-graphs")]
pub(crate) use variables::manifolds::wrapped;
pub use variables::manifolds::{Direction, PlanarMotion, RigidMotion, Rotation};
pub use variables::quaternion;
pub use variables::rotation_vector::RotationVector;
