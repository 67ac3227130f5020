//! Steps of the readings that are wider than the noise.

use nalgebra::Vector3;
use sensor::Sensor;

use super::of_sensor::{OfSensor, least_step};
use super::symptom::Symptom;
use crate::intervals::Segmentation;
use crate::recording::Recording;

findings::tuning! {
    /// Steps wider than so many standard deviations of the readings no longer average out.
    pub COARSE: f64 = 1.7;
}

/// `LSB/√12` of the axes on which a sensor's readings step by more than their noise, in their unit: that error of a mean stays, however
/// many samples there are.
pub fn error_of_steps(
    sensor: Sensor,
    recording: &Recording,
    segmentation: &Segmentation,
) -> Vector3<f64> {
    let of = OfSensor::new(sensor, recording, segmentation);
    let step = |axis| Some(coarse_step(of.as_ref()?, axis)?.0);
    Vector3::from_fn(|axis, _| step(axis).unwrap_or(0.0) / 12f64.sqrt())
}

/// The least step of an axis and its spread within static intervals, where the step exceeds that by far.
fn coarse_step(of: &OfSensor<'_>, axis: usize) -> Option<(f64, f64)> {
    let step = least_step(&of.stream.values, axis)?;
    let spread = of.usual_spread(axis)?;
    // Simulated readings without noise step by what rounding leaves.
    let size = of.stream.values.iter().map(|v| v[axis].abs());
    let largest = size.fold(0.0, f64::max);
    (COARSE.get() * spread < step && step > 1e-6 * largest).then_some((step, spread))
}

/// The axes whose least step exceeds the spread by far within static intervals; those of a dead zone are named by
/// that.
pub(super) fn found(of: &OfSensor<'_>, dead: Option<&Symptom>) -> Option<Symptom> {
    let in_dead_zone = |axis: &usize| match dead {
        Some(Symptom::DeadZone { axes, .. }) => axes.contains(axis),
        _ => false,
    };
    let coarse: Vec<(usize, f64, f64)> = (0..3)
        .filter(|axis| !in_dead_zone(axis))
        .filter_map(|axis| coarse_step(of, axis).map(|(step, spread)| (axis, step, spread)))
        .collect();
    let &(_, step, spread) = coarse.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Symptom::Quantised {
        sensor: of.sensor,
        axes: coarse.iter().map(|c| c.0).collect(),
        step,
        spread,
    })
}
