//! Which placements and turns a hand-held calibration needs.
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod accelerometer;
mod direction;
mod exchange;
mod relaxation;
mod requirement;
mod sequence;
mod session;
mod turn;

pub use accelerometer::*;
pub use direction::*;
pub use exchange::*;
pub use relaxation::*;
pub use requirement::*;
pub use sequence::*;
pub use session::*;
pub use turn::*;
