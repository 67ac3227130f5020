//! Evaluation of a calibration on a recording that it was not made from.

mod beyond_errors;
mod field;
mod misfits;

pub use field::FieldMisfit;
pub use misfits::{Misfit, Misfits, misfits};

use findings::Findings;
use nalgebra::Vector3;
use recording::averages::root_mean_square;
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use serde::Serialize;

use crate::calibration::Calibration;

/// The misfit of a recording to gravity under one calibration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evaluation {
    /// Number of rests.
    pub static_intervals: usize,
    /// Root mean square of `|f| − g` over the rests, m/s².
    pub modulus_rms: Option<f64>,
    /// Number of sound turns.
    pub turns: usize,
    /// Root mean square angle between the direction of gravity that the gyroscope predicts and the
    /// one that the accelerometer shows after each turn, degrees; what is left of the rate in the
    /// rests beside the turn is taken off as bias.
    pub direction_rms: Option<f64>,
    /// Mean of the corrected rate over the rests, rad/s: what the calibration's bias is off by. The angles above are
    /// measured with it taken off.
    pub static_rate: Option<[f64; 3]>,
    /// Distance of a static interval's mean rate from that mean, root mean square over the intervals of its norm, rad/s.
    pub static_rate_scatter: Option<f64>,
    /// The magnetic field over the rests; `None` without a magnetometer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub magnetic_field: Option<FieldMisfit>,
    /// Doubts about the calibration on this recording, by who compared them.
    #[serde(
        skip_serializing_if = "is_empty",
        with = "findings::texts::of_warnings"
    )]
    pub warnings: Findings,
}

fn is_empty(findings: &Findings) -> bool {
    findings.is_empty()
}

/// Measures a calibration, or the raw readings with `None`, on the rests and turns of a recording.
///
/// Only `apply` is asked for what the calibration makes of a reading.
///
/// # Errors
/// As [`crate::calibration::apply`].
pub fn evaluate(
    recording: &Recording,
    segmentation: &Segmentation,
    calibration: Option<&Calibration>,
    gravity: f64,
) -> Result<Evaluation, Error> {
    let misfits = misfits(recording, segmentation, calibration, gravity)?;
    let rms = |values: Vec<f64>| (!values.is_empty()).then(|| root_mean_square(&values));
    let values = |all: &[Misfit]| all.iter().map(|m| m.value).collect();
    let count = misfits.rates.len().max(1) as f64;
    let mean = misfits.rates.iter().sum::<Vector3<f64>>() / count;
    let scatter = misfits.rates.iter().map(|rate| (rate - mean).norm());
    let seen = !misfits.rates.is_empty();
    Ok(Evaluation {
        static_rate: seen.then(|| mean.into()),
        static_rate_scatter: rms(scatter.collect()),
        static_intervals: misfits.rests.len(),
        modulus_rms: rms(values(&misfits.rests)),
        turns: misfits.turns.len(),
        direction_rms: rms(values(&misfits.turns)),
        magnetic_field: FieldMisfit::of(&misfits.fields),
        warnings: match calibration {
            Some(calibration) => {
                let left = (gravity, &misfits);
                beyond_errors::beyond_errors(recording, segmentation, calibration, left)?.into()
            }
            None => Findings::new(),
        },
    })
}
