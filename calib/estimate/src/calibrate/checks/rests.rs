//! Rests and turns that are not what they seem.

use recording::Recording;
use recording::intervals::Segmentation;

use crate::methods::{AccelerometerFit, Choice};

/// Spread of a rest above which the device was not still, as a fraction of gravity.
const STILL: f64 = 0.05;

/// A turn longer than this may hide a rest, s.
const LONG_TURN: f64 = 15.0;

/// Rests that disagree with all the others, by name.
pub(in crate::calibrate) fn disagreeing_rests(
    fit: &AccelerometerFit,
    recordings: &[&Recording],
    choices: &[Choice],
) -> Vec<String> {
    let rests: Vec<_> = recordings
        .iter()
        .zip(choices)
        .flat_map(|(recording, choice)| {
            let rests = choice.segmentation.statics.iter().enumerate();
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
            format!(
                "{}: static interval {} (t = {:.2} to {:.2} s) disagrees with the others by {:.1} \
                 mm/s² (by chance in {:.0e} of recordings): was the device touched, or did it slip?",
                recording.name,
                k + 1,
                rest.span.from,
                rest.span.to,
                1e3 * outlier.deleted_residual,
                outlier.p_value
            )
        })
        .collect()
}

/// Turns that last much longer than the others: a rest in them may have been missed.
pub(in crate::calibrate) fn long_turns(
    recording: &Recording,
    segmentation: &Segmentation,
) -> Vec<String> {
    let mut lengths: Vec<f64> = segmentation.turns.iter().map(|t| t.span.length()).collect();
    lengths.sort_by(f64::total_cmp);
    let Some(&usual) = lengths.get(lengths.len() / 4) else {
        return Vec::new();
    };
    segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter(|turn| turn.span.length() > LONG_TURN.max(3.0 * usual))
        .map(|turn| {
            format!(
                "{}: turn {} lasts {:.1} s (t = {:.2} to {:.2} s): no rest was found in it; if the \
                 device was still, it vibrated or not for long enough (--min-static, --multiplier)",
                recording.name,
                turn.from + 1,
                turn.span.length(),
                turn.span.from,
                turn.span.to
            )
        })
        .collect()
}

/// Rests whose spread says that the device was not still.
pub(in crate::calibrate) fn restless(
    recording: &Recording,
    segmentation: &Segmentation,
    scale: f64,
    gravity: f64,
) -> Vec<String> {
    let unsteady = |rest: &recording::intervals::StaticInterval| {
        let spread = rest.accelerometer?.std().norm() * scale;
        (spread > STILL * gravity).then_some(spread)
    };
    segmentation
        .statics
        .iter()
        .enumerate()
        .filter_map(|(k, rest)| {
            let spread = unsteady(rest)?;
            Some(format!(
                "{}: static interval {} (t = {:.2} to {:.2} s) shakes by {spread:.2} m/s²: the \
                 device was not still",
                recording.name,
                k + 1,
                rest.span.from,
                rest.span.to
            ))
        })
        .collect()
}
