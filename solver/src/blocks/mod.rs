//! Many small blocks of parameters against a few shared ones.

mod elimination;
mod jacobian;
mod problem;
mod solve;
mod stack;
mod system;

pub(crate) use jacobian::BlockJacobian;
pub use problem::BlockProblem;
pub use solve::{BlockReport, solve_blocks};
