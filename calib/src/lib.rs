//! From hand-held recordings to calibrations.

mod error;
pub mod recording;

pub use error::Error;
pub use recording::Recording;
