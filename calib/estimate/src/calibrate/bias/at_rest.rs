//! The gyroscope's bias from the rests of a recording.

use nalgebra::Vector3;
use recording::Recording;
use recording::intervals::{Moments, Segmentation};
use recording::readings::{dead_zones, error_of_steps};
use sensor::Sensor;

use crate::calibration::RecordingBias;
use crate::methods::small_sample::widening;

/// The mean over the rests, with the scatter between them as its error.
///
/// Neighbouring rests of a wandering bias resemble each other: where their lag-one correlation `ρ` is
/// significant the variance of the mean grows by `(1 + ρ)/(1 − ρ)`, at most to that of a single rest.
/// Of steps wider than the noise `LSB/√12` stays: the bias is the same in every rest, and so is what rounding makes of it. A dead zone
/// leaves an error of its own.
pub fn rest_bias(recording: &Recording, segmentation: &Segmentation) -> Option<RecordingBias> {
    let rests: Vec<Moments> = segmentation
        .statics
        .iter()
        .filter_map(|s| s.gyroscope)
        .collect();
    let stream = recording.gyroscope.as_ref()?;
    let first = rests.first()?;
    let mean = rests.iter().map(|m| m.mean).sum::<Vector3<f64>>() / rests.len() as f64;
    let of_steps = error_of_steps(Sensor::Gyroscope, recording, segmentation);
    let ranges = segmentation.statics.iter().map(|s| s.span);
    let ranges: Vec<_> = ranges.map(|s| stream.between(s.from, s.to)).collect();
    let dead = dead_zones(stream, &ranges);
    let std = [0, 1, 2].map(|axis| {
        let between = if rests.len() > 1 {
            let deviations: Vec<f64> = rests.iter().map(|m| m.mean[axis] - mean[axis]).collect();
            variance_of_mean(&deviations)
        } else {
            first.covariance[(axis, axis)] / first.count as f64
        };
        let dead = dead[axis].map_or(0.0, |zone| zone.error_of_mean());
        let floor = of_steps[axis].max(dead);
        // With few rests their scatter is known badly: Student's t.
        let widened = between.sqrt() * widening(rests.len() - 1);
        Some(widened.max(floor))
    });
    Some(RecordingBias {
        recording: recording.name.clone(),
        bias: mean.into(),
        bias_std: std,
    })
}

/// The variance of the mean of correlated values, from their deviations.
fn variance_of_mean(deviations: &[f64]) -> f64 {
    let n = deviations.len() as f64;
    let square: f64 = deviations.iter().map(|d| d * d).sum();
    let variance = square / (n - 1.0);
    let product: f64 = deviations.windows(2).map(|w| w[0] * w[1]).sum();
    let correlation = product / square;
    if square > 0.0 && correlation > 2.0 / n.sqrt() {
        let inflation = (1.0 + correlation) / (1.0 - correlation).max(1.0 / n);
        variance * (inflation / n).min(1.0)
    } else {
        variance / n
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn independent_rests_average_out_and_a_ramp_does_not() {
        let alternating: Vec<f64> = (0..16)
            .map(|k| if k % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        assert!((variance_of_mean(&alternating) - 1.0 / 15.0).abs() < 1e-12);
        let ramp: Vec<f64> = (0..16).map(|k| f64::from(k) - 7.5).collect();
        let single = ramp.iter().map(|d| d * d).sum::<f64>() / 15.0;
        assert!(variance_of_mean(&ramp) > 0.4 * single);
    }
}
