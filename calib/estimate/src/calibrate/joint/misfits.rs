//! Findings about what a joint fit leaves: misfits, an effect that is missing, biases that moved.

use findings::{Finding, Findings, Kind};
use recording::Recording;
use sensor::Sensor;

use super::doubts::of_missing;
use super::temperature;
use super::triads::biases_that_moved;
use crate::calibration::{Remainder, WITH_WALKS};
use crate::methods::joint::JointFit;

/// Adds what a fit leaves to the findings. Where a device turned at rest, or its temperature changed, that is the cause, and is said first.
/// Nothing suggests a search where the fit is one of a search (`is_of_search`).
pub(super) fn say_misfits(
    fit: &JointFit,
    remainders: &[Remainder],
    recordings: &[&Recording],
    is_of_search: bool,
    warnings: &mut Findings,
) {
    let has_thermometer = recordings.iter().any(|r| r.temperature.is_some());
    let turned_at_rest = warnings.has(Kind::RESTS_TURN);
    let misfits = remainders
        .iter()
        .filter_map(|r| r.finding(WITH_WALKS.get()));
    let mut left: Vec<Finding> = misfits.collect();
    // That motion is no effect of a sensor and no bias that moves.
    if !turned_at_rest {
        if !is_of_search {
            let missing = fit.missing(recordings);
            left.extend(missing.and_then(|missing| of_missing(&missing)));
        }
        let both = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        for (sensor, motions) in both.zip(&fit.bias_motions()) {
            let moved = biases_that_moved(fit, sensor, motions).into_iter();
            left.extend(moved.map(|found| match has_thermometer {
                true => found,
                false => found.detail("like", "as with temperature"),
            }));
        }
    }
    let warmed = match is_of_search {
        true => None,
        false => temperature::changed(fit, recordings, !left.is_empty()),
    };
    for found in &mut left {
        if turned_at_rest || warmed.is_some() {
            found.consequence.clear();
        }
        if turned_at_rest || is_of_search {
            found.remedies.clear();
        }
    }
    warnings.extend(left);
    warnings.extend(warmed);
}
