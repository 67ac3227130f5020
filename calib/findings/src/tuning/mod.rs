//! Tuning constants: numbers that decide, such as the level of a test, in tables that a study can vary.
//!
//! A law of physics, a size of a matrix and a digit of a series are none: with another value the program would be wrong. With another
//! tuning constant it would be another program, so each has a meaning, and a study says how much depends on it
//! (`cli/manual/tuning.md`).
//!
//! ```
//! stillpoint_findings::tuning! {
//!     /// A clock is late from so many standard errors on.
//!     LATE: f64 = 3.0;
//! }
//! assert!(3.5 > LATE.get());
//! ```

#[cfg(not(feature = "vary"))]
mod fixed;
#[cfg(feature = "vary")]
mod varied;

#[cfg(not(feature = "vary"))]
pub use fixed::Tuning;
#[cfg(feature = "vary")]
pub use varied::{Tuning, Vary, reached, vary};
