//! Samples of a sensor at rest, before their Allan deviation: what is lost, repeated, alone, too coarse, drifting or moved.

pub mod changes;
pub mod coarse;
pub mod held;
pub mod lost;
pub mod outliers;
pub mod stillness;
