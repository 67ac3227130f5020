//! When the device was still and when it turned.
//!
//! ```text
//! Recording ──► Detector ──► spans of motion ──► Segmentation: StaticInterval · Turn · StaticInterval …
//! ```

mod detector;
mod moments;
mod saturation;
mod sections;
mod segmentation;
mod spans;

pub use detector::{Detector, Level};
pub use moments::Moments;
pub use saturation::Rails;
pub use sections::read_sections;
pub use segmentation::{Segmentation, StaticInterval, Turn, TurnFault, segment, segment_each};
pub use spans::Span;
pub(crate) use spans::{complement, union};
