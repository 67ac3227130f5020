//! When a sensor samples, what its clock says, and how a reading becomes a number in a file.

mod clock;
mod readout;
mod resampling;

use serde::{Deserialize, Serialize};

pub use clock::{Clock, Stamp};
pub(crate) use clock::{ClockChange, Tick, Ticks};
pub(crate) use readout::{Readout, ZERO_COUNT};
pub(crate) use resampling::Resampler;
pub use resampling::{Between, Resampled};

/// Value of a sample with respect to its window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// The mean over the window of one step: a filter in the sensor.
    #[default]
    Average,
    /// The value at the stamp: a wide-band sensor without a filter. What changes within a step is lost.
    Point,
}
