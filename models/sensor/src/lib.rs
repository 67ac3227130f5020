//! What every sensor model is made of: `raw = base⁻¹(truth + Σ effect(truth))`.
//!
//! ```text
//! Kinematics ──► Effect (one file each) ─┐
//!                Base  T (m − b) ────────┴► Model ──► distort (simulate) · correct (calibrate)
//! ```

pub mod attitude;
mod axis;
mod base;
mod effect;
mod invert;
mod kinematics;
mod model;
mod param;

pub use axis::Axis;
pub use base::{BASE_PARAMETERS, Base, PLACES, base_names, inverse};
pub use effect::{AnyEffect, Effect, ModelScalar, mat3};
pub use kinematics::{Kinematics, REFERENCE_TEMPERATURE, Sensor};
pub use model::Model;
pub use param::{Param, params};
