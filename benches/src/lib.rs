//! What the benches and tables share.

#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod curve_file;
pub mod graphs;
pub mod nist_study;
pub mod problem_study;
pub mod stages;
pub mod turns;
