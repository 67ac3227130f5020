//! Small signals that read as exactly zero.

use std::ops::Range;

use nalgebra::Vector3;
use sensor::Sensor;

use super::{Finding, OfSensor, least_beside_zero, least_step};
use crate::recording::Stream;

/// Share of zeros in static intervals that a working sensor of any noise does not give.
const SHARE: f64 = 0.3;

/// The smallest reading beside zero is that of a dead zone where it is so many least steps wide.
const WIDE: f64 = 3.0;

/// Steps finer than this part of the largest reading resolve any sensor's noise: zeros between them are
/// made.
const FINE: f64 = 1e-6;

/// The axes of a gyroscope that read zero at rest though their steps are finer than what lies around zero.
pub(super) fn found(of: &OfSensor<'_>) -> Option<Finding> {
    if of.sensor != Sensor::Gyroscope {
        return None;
    }
    let zones = [0, 1, 2].map(|axis| {
        let at_rest = of.samples().map(move |value| value[axis]);
        DeadZone::of(at_rest, &of.stream.values, axis)
    });
    let dead = || {
        let zones = zones.iter().enumerate();
        zones.filter_map(|(axis, zone)| zone.map(|zone| (axis, zone)))
    };
    let (_, widest) = dead().max_by(|a, b| a.1.share.total_cmp(&b.1.share))?;
    Some(Finding::DeadZone {
        sensor: of.sensor,
        axes: dead().map(|(axis, _)| axis).collect(),
        share: widest.share,
        least: widest.edge,
    })
}

/// Half the width of the dead zone of each axis of a gyroscope, from its samples in stretches of rest (3); 0 where an axis
/// has none.
pub fn dead_zones(stream: &Stream, rests: &[Range<usize>]) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| {
        let rests = rests.iter().flat_map(|rest| &stream.values[rest.clone()]);
        let zone = DeadZone::of(rests.map(|v| v[axis]), &stream.values, axis);
        zone.map_or(0.0, |zone| zone.edge)
    })
}

/// What an axis shows that reads zero at rest.
#[derive(Clone, Copy, Debug)]
struct DeadZone {
    /// Of the readings at rest that are zero.
    share: f64,
    /// The smallest reading beside zero: half the width of the zone.
    edge: f64,
}

impl DeadZone {
    fn of(
        at_rest: impl Iterator<Item = f64>,
        values: &[Vector3<f64>],
        axis: usize,
    ) -> Option<Self> {
        let (mut all, mut zeros) = (0usize, 0usize);
        for value in at_rest {
            all += 1;
            zeros += usize::from(value == 0.0);
        }
        let share = zeros as f64 / all.max(1) as f64;
        if share < SHARE {
            return None;
        }
        let edge = least_beside_zero(values, axis)?;
        let largest = values.iter().map(|v| v[axis].abs()).fold(0.0, f64::max);
        let step = least_step(values, axis)?;
        (edge > WIDE * step || step < FINE * largest).then_some(Self { share, edge })
    }
}
