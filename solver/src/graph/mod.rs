//! Problems of named blocks of variables and factors over a few of them.
//!
//! ```text
//! Residual<D> ──► Factor ┐
//! Manifold ─────► Block ─┴► Graph ──► solve_graph ──► GraphReport
//! ```
//! How a step is found: `normal` adds up `H = JᵀJ` and `g = Jᵀr` block by block; `eliminate` takes
//! small blocks out one by one; `reduced` factors what is left: dense, sparse, or, of little fill, by
//! `block_cholesky`.

mod accumulate;
mod block_cholesky;
mod blocks;
mod culprit;
mod damping;
mod display;
mod eliminate;
mod evaluate;
mod factor;
mod fill;
mod manifold;
mod manifolds;
mod neighbours;
mod normal;
mod null_space;
mod options;
mod order;
mod outer;
mod problem;
mod product;
mod products;
mod profile;
pub mod quaternion;
mod reduced;
mod reweight;
mod rotation_vector;
mod solve;
mod step;
mod structure;
mod update;

pub use eliminate::Method;
pub use factor::Factor;
pub use manifold::{Euclidean, Manifold, check_manifold};
pub use manifolds::{Direction, PlanarMotion, RigidMotion, Rotation};
pub use null_space::NullVector;
pub use options::{GraphOptions, GraphReport};
pub use problem::{Block, Graph};
pub use products::Products;
pub use profile::graph_profile;
pub use rotation_vector::RotationVector;
pub use solve::solve_graph;
