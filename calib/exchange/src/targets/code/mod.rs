//! Targets that are code: functions that correct readings.

mod c_header;
mod effects;
mod rust_module;

pub use c_header::CHeader;
pub use effects::is_code;
pub use rust_module::RustModule;
