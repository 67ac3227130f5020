//! When the device was still and when it turned.
//!
//! ```text
//! Recording ──► Survey ──► spans of motion ──► Segmentation: StaticInterval · Turn · StaticInterval …
//!               Detector   at a multiplier
//! ```

mod detector;
mod ends;
mod moments;
mod rejected;
mod saturation;
mod sections;
mod segmentation;
mod shaken;
mod spans;
mod stamps;
mod stillness;
mod survey;
mod tilt;
mod unexplained_turn;

pub use detector::options::DetectorOptions;
pub use detector::{Detector, Level};
pub use moments::Moments;
pub use rejected::{Reason, Rejected};
pub use saturation::Rails;
pub use sections::read_sections;
pub use segmentation::{Part, Segmentation, StaticInterval, Turn, TurnFault, is_of};
pub use spans::Span;
pub use spans::{complement, union};
pub use survey::{Survey, segment};
