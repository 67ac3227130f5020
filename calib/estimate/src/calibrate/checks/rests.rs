//! Rests and turns that are not what they seem.

use findings::{Finding, Kind};
use recording::Recording;
use recording::intervals::Segmentation;
use sensor::Sensor;

use crate::methods::AccelerometerFit;

findings::tuning! {
    /// Spread of a rest above which the device was not still, as a fraction of gravity.
    STILL: f64 = 0.05;

    /// A turn longer than this may hide a rest, s.
    LONG_TURN: f64 = 15.0;
}

/// Rests that disagree with all the others, by name.
pub(in crate::calibrate) fn disagreeing_rests<'a>(
    fit: &AccelerometerFit,
    cut: impl Iterator<Item = (&'a Recording, &'a Segmentation)>,
) -> Vec<Finding> {
    let rests: Vec<_> = cut
        .flat_map(|(recording, segmentation)| {
            let rests = segmentation.statics.iter().enumerate();
            rests.map(move |(k, rest)| (recording, k, rest))
        })
        .filter(|(_, _, rest)| rest.accelerometer.is_some())
        .collect();
    if rests.len() != fit.first.residuals.len() {
        return Vec::new();
    }
    fit.outliers
        .iter()
        .map(|outlier| {
            let (recording, k, rest) = rests[outlier.row];
            Finding::of(Kind::INTERVAL_DISAGREES)
                .in_recording(&recording.name)
                .at_interval(k)
                .between(rest.span.from, rest.span.to)
                .of_sensor(Sensor::Accelerometer)
                .number("size", outlier.deleted_residual, "m/s^2")
                .detail("p", format!("{:.0e}", outlier.p_value))
                .affects("corrected_reading", outlier.deleted_residual, "m/s^2")
        })
        .collect()
}

/// Turns that last much longer than the others: a rest in them may have been missed.
pub(in crate::calibrate) fn long_turns(
    recording: &Recording,
    segmentation: &Segmentation,
) -> Vec<Finding> {
    let mut lengths: Vec<f64> = segmentation.turns.iter().map(|t| t.span.length()).collect();
    lengths.sort_by(f64::total_cmp);
    let Some(&usual) = lengths.get(lengths.len() / 4) else {
        return Vec::new();
    };
    segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter(|turn| turn.span.length() > LONG_TURN.get().max(3.0 * usual))
        .map(|turn| {
            Finding::of(Kind::LONG_TURN)
                .in_recording(&recording.name)
                .at_turn(segmentation.before() + turn.from)
                .between(turn.span.from, turn.span.to)
                .number("length", turn.span.length(), "s")
        })
        .collect()
}

/// Rests whose spread says that the device was not still.
pub(in crate::calibrate) fn restless(
    recording: &Recording,
    segmentation: &Segmentation,
    scale: f64,
    gravity: f64,
) -> Vec<Finding> {
    let unsteady = |rest: &recording::intervals::StaticInterval| {
        let spread = rest.accelerometer?.std().norm() * scale;
        (spread > STILL.get() * gravity).then_some(spread)
    };
    segmentation
        .statics
        .iter()
        .enumerate()
        .filter_map(|(k, rest)| {
            let spread = unsteady(rest)?;
            Some(
                Finding::of(Kind::NOT_STILL)
                    .in_recording(&recording.name)
                    .at_interval(segmentation.before() + k)
                    .between(rest.span.from, rest.span.to)
                    .of_sensor(Sensor::Accelerometer)
                    .number("spread", spread, "m/s^2"),
            )
        })
        .collect()
}
