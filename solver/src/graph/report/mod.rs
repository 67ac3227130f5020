//! Report on the end point of a run.

mod display;
mod ending;
