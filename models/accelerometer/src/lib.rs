//! The accelerometer: `f = T (A − b)` plus effects, in the triangular frame.

pub mod effects;
mod frame;

pub use effects::EFFECTS;
pub use frame::{FIXED_BY_FRAME, is_free_in_triangular_frame};
use sensor::{Model, Sensor};

/// The base model of an accelerometer.
pub fn model() -> Model {
    Model::base(Sensor::Accelerometer)
}
