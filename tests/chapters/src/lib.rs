//! The Rust blocks of the manual and of the project's README compile and hold, as documentation tests.
//!
//! Not in the crates that they are about: those are published without the files of the folders beside them.

/// The project's README.
#[doc = include_str!("../../../README.md")]
#[cfg(doctest)]
pub struct Readme;

/// The manual's chapter on the solver.
#[doc = include_str!("../../../cli/manual/solver.md")]
#[cfg(doctest)]
pub struct Solver;

/// The manual's chapter on effects of one's own.
#[doc = include_str!("../../../cli/manual/extending.md")]
#[cfg(doctest)]
pub struct Extending;
