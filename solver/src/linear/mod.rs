//! The problem linearised at a point, `r + J p`, and the ways to solve for `p`.

pub(crate) mod vector;

mod cholesky;
mod damped_triangle;
mod factor;
mod householder;
mod jacobi;
mod jacobian;
mod method;
mod minimum_norm;
mod product;
mod qr;
mod tall;
mod triangle;

pub use factor::Factor;
pub(crate) use jacobi::singular;
pub(crate) use jacobian::{Jacobian, Linearization};
pub use method::{LinearMethod, LinearSolver, OwnLinearSolver};
pub(crate) use minimum_norm::minimum_norm;
pub(crate) use product::{multiply, transpose_multiply};
pub(crate) use qr::QrFactor;
