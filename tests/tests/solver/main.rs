//! The solver on problems that others have solved.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod collections;
mod held_out;
mod nist;
mod residual_jacobians;
