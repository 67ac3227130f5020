//! What the benches and tables share.

pub mod curve_file;
pub mod nist_study;
pub mod problem_study;
pub mod stages;
pub mod turns;
