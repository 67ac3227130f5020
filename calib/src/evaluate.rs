//! What a calibration is worth on a recording that it has not seen.

use nalgebra::Vector3;
use serde::Serialize;

use crate::calibration::{Calibration, apply};
use crate::intervals::{Segmentation, Turn};
use crate::recording::{Recording, Stream};
use crate::residuals::{Integrator, attitude_of};

/// The misfit of a recording to gravity under one calibration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evaluation {
    /// Number of rests.
    pub static_intervals: usize,
    /// Root mean square of `|f| − g` over the rests, m/s².
    pub modulus_rms: Option<f64>,
    /// Number of sound turns.
    pub turns: usize,
    /// Root mean square angle between the direction of gravity that the gyroscope foretells and the
    /// one that the accelerometer shows after each turn, degrees; what is left of the rate in the
    /// rests beside the turn is taken off as bias.
    pub direction_rms: Option<f64>,
}

/// Measures a calibration, or the raw readings with `None`, on the rests and turns of a recording.
///
/// Only `apply` is asked for what the calibration makes of a reading.
pub fn evaluate(
    recording: &Recording,
    segmentation: &Segmentation,
    calibration: Option<&Calibration>,
    gravity: f64,
) -> Evaluation {
    let corrected = calibration.map_or_else(|| recording.clone(), |c| apply(c, recording));
    let spans: Vec<_> = segmentation.statics.iter().map(|rest| rest.span).collect();
    let rests = Segmentation::from_spans(&corrected, &spans, segmentation.multiplier);
    let moduli: Vec<f64> = rests
        .statics
        .iter()
        .filter_map(|rest| Some(rest.accelerometer?.mean.norm() - gravity))
        .collect();
    let angles: Vec<f64> = segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter_map(|turn| angle(corrected.gyroscope.as_ref()?, &rests, turn))
        .collect();
    Evaluation {
        static_intervals: moduli.len(),
        modulus_rms: root_mean_square(&moduli),
        turns: angles.len(),
        direction_rms: root_mean_square(&angles),
    }
}

/// The angle by which the corrected rate misses gravity after a turn, degrees.
fn angle(rate: &Stream, rests: &Segmentation, turn: &Turn) -> Option<f64> {
    let (before, after) = (
        rests.statics.get(turn.from)?,
        rests.statics.get(turn.from + 1)?,
    );
    let bias: Vector3<f64> = 0.5 * (before.gyroscope?.mean + after.gyroscope?.mean);
    let values = &rate.values[turn.samples.clone()];
    let t = &rate.t[turn.samples.clone()];
    let attitude = attitude_of(Integrator::Exponential, t, |k| values[k] - bias);
    let foretold = attitude.into_body(&before.accelerometer?.mean);
    Some(foretold.angle(&after.accelerometer?.mean).to_degrees())
}

fn root_mean_square(values: &[f64]) -> Option<f64> {
    let square = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
    (!values.is_empty()).then(|| square.sqrt())
}
