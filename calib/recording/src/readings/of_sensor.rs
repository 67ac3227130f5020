//! One sensor in its static intervals.

use nalgebra::Vector3;
use sensor::Sensor;

use crate::averages::median;
use crate::intervals::{Moments, Segmentation, StaticInterval};
use crate::recording::content::Recording;
use crate::recording::stream::Stream;

/// One sensor in its static intervals.
pub(super) struct OfSensor<'a> {
    pub sensor: Sensor,
    pub stream: &'a Stream,
    /// Places of the static intervals with samples, and their moments.
    pub moments: Vec<(usize, Moments)>,
    pub statics: &'a [StaticInterval],
}

impl<'a> OfSensor<'a> {
    pub fn new(
        sensor: Sensor,
        recording: &'a Recording,
        segmentation: &'a Segmentation,
    ) -> Option<Self> {
        let of_interval = |interval: &StaticInterval| interval.moments(sensor);
        let stream = recording.stream(sensor);
        let statics = &segmentation.statics;
        let moments = statics.iter().enumerate();
        Some(Self {
            sensor,
            stream: stream?,
            moments: moments
                .filter_map(|(k, interval)| Some((k, of_interval(interval)?)))
                .collect(),
            statics,
        })
    }

    /// The median over the static intervals of the standard deviation of an axis; `None` without any.
    pub fn usual_spread(&self, axis: usize) -> Option<f64> {
        let spreads = self.moments.iter().map(|(_, m)| m.std()[axis]);
        median(spreads)
    }

    /// The samples of all static intervals.
    pub fn samples(&self) -> impl Iterator<Item = &Vector3<f64>> {
        let spans = self.moments.iter().map(|(k, _)| self.statics[*k].span);
        spans.flat_map(|span| &self.stream.values[self.stream.between(span.from, span.to)])
    }
}

/// The row of the first sample, under a line of header.
pub(super) const FIRST_ROW: usize = 2;

/// The smallest size of an axis's readings that are not zero; `None` where all are.
pub(super) fn least_beside_zero(values: &[Vector3<f64>], axis: usize) -> Option<f64> {
    let sizes = values.iter().map(|v| v[axis].abs()).filter(|&v| v > 0.0);
    sizes.min_by(f64::total_cmp)
}

/// The smallest difference of neighbouring values of an axis that differ; `None` where none do.
pub fn least_step(values: &[Vector3<f64>], axis: usize) -> Option<f64> {
    let steps = values
        .windows(2)
        .map(|pair| (pair[1][axis] - pair[0][axis]).abs());
    steps.filter(|&step| step > 0.0).min_by(f64::total_cmp)
}
