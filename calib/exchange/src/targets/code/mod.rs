//! Targets that are code: functions that correct readings.

pub(super) mod c_header;
mod effects;
pub(super) mod rust_module;

pub use effects::is_code;
