//! Small signals that read as exactly zero.

use sensor::Sensor;

use super::{Finding, OfSensor, least_step};

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
    let dead: Vec<(usize, f64, f64)> = (0..3)
        .filter_map(|axis| {
            let (mut all, mut zeros) = (0usize, 0usize);
            for value in of.samples() {
                all += 1;
                zeros += usize::from(value[axis] == 0.0);
            }
            let share = zeros as f64 / all.max(1) as f64;
            if share < SHARE {
                return None;
            }
            let values = &of.stream.values;
            let sizes = || values.iter().map(move |v| v[axis].abs());
            let least = sizes().filter(|&v| v > 0.0).min_by(f64::total_cmp)?;
            let largest = sizes().fold(0.0, f64::max);
            let step = least_step(values, axis)?;
            (least > WIDE * step || step < FINE * largest).then_some((axis, share, least))
        })
        .collect();
    let &(_, share, least) = dead.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Finding::DeadZone {
        sensor: of.sensor,
        axes: dead.iter().map(|d| d.0).collect(),
        share,
        least,
    })
}
