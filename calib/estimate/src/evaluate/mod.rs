//! Evaluation of a calibration on a recording that it was not made from.

mod beyond_errors;
mod field;
mod misfits;

pub use field::FieldMisfit;
pub(crate) use misfits::unspoilt;
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

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use sensor::Sensor;
    use simulate::Spec;

    use super::*;
    use crate::calibrate::{Request, calibrate};

    #[test]
    fn a_calibration_is_doubted_where_its_scale_factors_are_twenty_errors_off_and_else_not() {
        let spec = Spec::hand_held(3);
        let mut recording = spec.run().unwrap().recording;
        let request = Request {
            gravity: spec.gravity,
            ..Request::default()
        };
        let made = calibrate(std::slice::from_ref(&recording), &[], &request);
        let mut calibration = made.unwrap().calibration;
        // A sample less is another recording of the same device.
        let streams = [&mut recording.accelerometer, &mut recording.gyroscope];
        for stream in streams.into_iter().flatten() {
            stream.t.pop();
            stream.values.pop();
        }
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let doubts = |calibration: &Calibration| -> Vec<Option<Sensor>> {
            let left = evaluate(&recording, &segmentation, Some(calibration), spec.gravity);
            let found = left.unwrap().warnings;
            found.iter().map(|found| found.place.sensor).collect()
        };
        assert_eq!(doubts(&calibration), []);
        let sensors = [Sensor::Accelerometer, Sensor::Gyroscope];
        for sensor in sensors {
            let own = calibration.triad_mut(sensor).unwrap();
            for (axis, errors) in [20.0, -20.0, 20.0].into_iter().enumerate() {
                own.t[axis][axis] += errors * own.t_std[axis][axis].unwrap();
            }
        }
        assert_eq!(doubts(&calibration), sensors.map(Some));
    }
}
