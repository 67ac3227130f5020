//! Building blocks of every sensor model: `raw = base⁻¹(truth + Σ effect(truth))`.
//!
//! ```text
//! Kinematics ──► Effect (one file each) ─┐
//!                Base  T (m − b) ────────┴► Model ──► distort (simulate) · correct (calibrate)
//! ```
//! An effect that several sensors have alike is a [`CommonEffect`]; [`Sensor::has`] makes it the effect of one.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod attitude;
mod axis;
mod base;
mod common_effect;
mod covariate;
mod definition;
mod effect;
pub mod effects;
pub mod expression;
mod invert;
mod kinematics;
mod model;
mod param;
mod quantity;
mod scalar_sensor;

pub use axis::Axis;
pub use base::{BASE_PARAMETERS, Base, BasePart, PLACES, base_names, base_part, inverse, is_bias};
pub use common_effect::{CommonEffect, On};
pub use covariate::{Covariate, NoSuchCovariate};
pub use definition::{
    DefinedParam, Definition, DefinitionError, DefinitionFault, EffectFault, ErrorCode, Factor,
    Formula, Term, emit_effect, error_code,
};
pub use effect::{
    AnyEffect, Effect, EffectRef, ModelScalar, Nature, is_linear_in_name_only, mat3,
    observed_needs, off_diagonal, silent_at_rest,
};
pub use kinematics::{Kinematics, REFERENCE_TEMPERATURE, Sensor, Since};
pub use model::Model;
pub use param::{Param, Role, axes, axes_and, params};
pub use quantity::Quantity;
pub use scalar_sensor::{AnyScalarSensor, ScalarSensor, ScalarSensorRef};
