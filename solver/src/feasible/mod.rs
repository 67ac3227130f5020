//! The set `{z : lower ≤ A z ≤ upper}` and steps within it.

pub(crate) mod cone_program;

mod face;
mod least_distance;
mod minimum;
mod model;
mod multipliers;
mod polytope;
mod projection;
mod quadratic_program;

pub(crate) use face::Face;
pub(crate) use model::Model;
pub(crate) use polytope::{Active, Polytope, Side};
