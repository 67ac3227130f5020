//! Biases alone: from a device at rest, and how far they move.

pub(super) mod at_rest;
mod moved;

pub use moved::{count_motion, count_motion_of};
