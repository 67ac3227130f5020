//! Dead reckoning: the equations of motion solved with a calibrated recording.
//!
//! ```text
//! Recording ──► apply(calibration) ──► Motion (rest · motion · rest) ──► reckon ──► Track
//! ```
//!
//! [`published`] is the other way: the procedure behind the authors' table, kept to reproduce it.

mod butterworth;
mod ending;
mod motion;
pub mod published;
mod track;

pub use ending::Ending;
pub use motion::{Motion, gap_in};
pub use track::{Mode, Track, reckon};
