//! One recording with its magnetometer, and what is measured of all.

use recording::intervals::Segmentation;
use recording::{Recording, Stream};

use super::inertial::Inertial;
use crate::methods::magnetic::{HeadingChange, Placement};
use crate::truth::{Models, Truth};

/// Measurements of all recordings.
#[derive(Debug, Default)]
pub struct Collected {
    pub placements: Vec<Placement>,
    pub changes: Vec<HeadingChange>,
    /// Density of the walk of the gyroscope's bias, rad/s/√s.
    pub walk: f64,
}

/// One recording.
pub(super) struct Source<'a> {
    pub number: usize,
    pub recording: &'a Recording,
    pub segmentation: &'a Segmentation,
    pub field: &'a Stream,
    pub unit: f64,
    pub truth: Truth<'a>,
    pub models: Models,
    pub inertial: &'a Inertial,
    /// Reduced chi-square of the turns' directions, at least 1.
    pub misfit: f64,
    /// Ratio of the scatter of the rate's means to that by white noise of the same samples.
    pub colour: f64,
}
