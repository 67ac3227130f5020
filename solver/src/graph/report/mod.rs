//! What is said of the point where a run ends.

mod display;
mod ending;
