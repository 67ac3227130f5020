//! What the readings themselves show of a sensor or of how it was recorded, before any model is fitted.
//!
//! ```text
//! file ──► Recording (stuck axes refused, an erased tail cut) ──► without_spikes ──► intervals ──► findings
//! ```

mod clipping;
mod dead_zone;
mod erased_tail;
mod finding;
mod hand;
mod level;
mod quantisation;
mod quietest;
mod spikes;
mod stuck;
mod vibration;

pub(crate) use clipping::limits;
pub use dead_zone::{DeadZone, dead_zones};
pub(crate) use erased_tail::cut_erased_tail;
pub use finding::Finding;
pub use hand::FASTEST_HAND;
pub use hand::tremor;
pub(crate) use level::{LevelChange, level_change};
pub use quantisation::COARSE;
pub use quietest::{Quiet, quietest};
pub use spikes::without_spikes;
pub(crate) use stuck::stuck;

use nalgebra::Vector3;
use sensor::Sensor;

use crate::averages::median;
use crate::intervals::{Moments, Segmentation, StaticInterval};
use crate::recording::{Recording, Stream};

/// Everything that the readings show once it is known where the device was still.
pub fn findings(recording: &Recording, segmentation: &Segmentation) -> Vec<Finding> {
    let mut all = Vec::new();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let Some(of) = OfSensor::new(sensor, recording, segmentation) else {
            continue;
        };
        let dead = dead_zone::found(&of);
        let coarse = quantisation::found(&of, dead.as_ref());
        all.extend(clipping::found(&of, &recording.warnings));
        // Where steps are wide, how much readings scatter says how near a step they are.
        if dead.is_none() && coarse.is_none() {
            all.extend(vibration::found(&of));
        }
        all.extend(dead);
        all.extend(coarse);
    }
    all.extend(hand::found(recording));
    all
}

/// One sensor in its static intervals.
struct OfSensor<'a> {
    sensor: Sensor,
    stream: &'a Stream,
    /// Places of the static intervals with samples, and their moments.
    moments: Vec<(usize, Moments)>,
    statics: &'a [StaticInterval],
}

impl<'a> OfSensor<'a> {
    fn new(
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
    fn usual_spread(&self, axis: usize) -> Option<f64> {
        let spreads = self.moments.iter().map(|(_, m)| m.std()[axis]);
        median(spreads)
    }

    /// The samples of all static intervals.
    fn samples(&self) -> impl Iterator<Item = &Vector3<f64>> {
        let spans = self.moments.iter().map(|(k, _)| self.statics[*k].span);
        spans.flat_map(|span| &self.stream.values[self.stream.between(span.from, span.to)])
    }
}

/// The row of the first sample, under a line of header.
const FIRST_ROW: usize = 2;

/// The smallest size of an axis's readings that are not zero; `None` where all are.
fn least_beside_zero(values: &[Vector3<f64>], axis: usize) -> Option<f64> {
    let sizes = values.iter().map(|v| v[axis].abs()).filter(|&v| v > 0.0);
    sizes.min_by(f64::total_cmp)
}

/// The smallest difference of neighbouring values of an axis that differ; `None` where none do.
fn least_step(values: &[Vector3<f64>], axis: usize) -> Option<f64> {
    let steps = values
        .windows(2)
        .map(|pair| (pair[1][axis] - pair[0][axis]).abs());
    steps.filter(|&step| step > 0.0).min_by(f64::total_cmp)
}
