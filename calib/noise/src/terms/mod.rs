//! Noise terms of an Allan curve: their shapes, their fit by generalised least squares, their intervals.

pub mod covariance;
pub mod identify;
pub mod interval;
pub mod octaves;
pub mod settling;
pub mod term;
