//! Steps of the readings that are wider than the noise.

use super::of_sensor::{OfSensor, least_step};
use super::symptom::Symptom;

/// Steps wider than so many standard deviations of the readings no longer average out.
pub const COARSE: f64 = 1.7;

/// The axes whose least step exceeds the spread by far within static intervals; those of a dead zone are named by
/// that.
pub(super) fn found(of: &OfSensor<'_>, dead: Option<&Symptom>) -> Option<Symptom> {
    let in_dead_zone = |axis: &usize| match dead {
        Some(Symptom::DeadZone { axes, .. }) => axes.contains(axis),
        _ => false,
    };
    let coarse: Vec<(usize, f64, f64)> = (0..3)
        .filter(|axis| !in_dead_zone(axis))
        .filter_map(|axis| {
            let step = least_step(&of.stream.values, axis)?;
            let spread = of.usual_spread(axis)?;
            // Simulated readings without noise step by what rounding leaves.
            let size = of.stream.values.iter().map(|v| v[axis].abs());
            let largest = size.fold(0.0, f64::max);
            (COARSE * spread < step && step > 1e-6 * largest).then_some((axis, step, spread))
        })
        .collect();
    let &(_, step, spread) = coarse.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Symptom::Quantised {
        sensor: of.sensor,
        axes: coarse.iter().map(|c| c.0).collect(),
        step,
        spread,
    })
}
