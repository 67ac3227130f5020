//! Remainder: the disagreement that no effect of the catalogue explains.

mod biases;
pub(super) mod described;
mod harmonics;
mod jumps;
pub(super) mod scatter;
pub(super) mod shape;
pub(super) mod shapes;
mod two_levels;
pub(super) mod unexplained;
pub(super) mod withdrawn;
