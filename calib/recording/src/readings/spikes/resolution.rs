//! One spike, and the steps that readings are in.

use nalgebra::Vector3;
use sensor::Sensor;

use crate::order_statistic::nth_smallest;
use crate::readings::lone_sample::Resolution;
use crate::readings::of_sensor::{least_beside_zero, least_step};

findings::tuning! {
    /// Places looked at in vain before the smaller ones are left.
    pub(super) MOST_MISSES: usize = 60;
}

/// A reading far from its neighbours.
pub(super) struct Spike {
    pub(super) axis: usize,
    /// Its place among the samples.
    pub(super) at: usize,
    /// Distance from the nearer neighbour.
    pub(super) size: f64,
}

findings::tuning! {
    /// Share of the readings that the usual reach holds.
    USUAL_SHARE: f64 = 0.98;
}

/// The size that nearly all readings reach.
pub(super) fn usual_reach(values: &[Vector3<f64>]) -> f64 {
    let rank = (USUAL_SHARE.get() * values.len() as f64) as usize;
    nth_smallest(values.iter().map(Vector3::amax), rank).unwrap_or(0.0)
}

/// The smallest changes that an axis of a sensor can show.
pub(super) fn resolution(sensor: Sensor, values: &[Vector3<f64>], axis: usize) -> Resolution {
    Resolution {
        step: least_step(values, axis).unwrap_or(0.0),
        // Gyroscopes alone are made with dead zones.
        beside_zero: match sensor {
            Sensor::Accelerometer | Sensor::Magnetometer => 0.0,
            Sensor::Gyroscope => least_beside_zero(values, axis).unwrap_or(0.0),
        },
    }
}
