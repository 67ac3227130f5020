//! Manifolds of blocks of variables, and the steps they take.

pub(crate) mod manifold;
pub(crate) mod manifolds;
pub mod quaternion;
pub(crate) mod rotation_vector;
pub(crate) mod step;
