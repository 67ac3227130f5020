//! Matrices cut into the rows of the recordings: these share parameters and no noise, so that work and memory grow
//! with their number and no faster.

pub(crate) mod arrow;
pub(crate) mod basis;
pub(crate) mod column;
pub(crate) mod columns;
pub(crate) mod covariance;
pub(crate) mod groups;
