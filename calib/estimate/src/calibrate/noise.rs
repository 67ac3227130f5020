//! Noise of the residuals that the noise within the static intervals predicts.

use nalgebra::Vector3;
use recording::intervals::{Moments, Segmentation};
use recording::{Recording, Stream};
use sensor::Base;

use crate::methods::joint::SensorNoise;

findings::tuning! {
    /// Time left out at either end of a static interval, where it may still move, for the long-run noise, s.
    ENDS: f64 = 0.5;
}

/// Returns the ratio of the scatter of a static interval's mean to that by white noise of the same samples; 1 where it
/// cannot be measured.
pub(super) fn long_run(stream: Option<&Stream>, segmentation: &Segmentation) -> f64 {
    let Some(stream) = stream else { return 1.0 };
    let rests: Vec<_> = segmentation
        .statics
        .iter()
        .map(|rest| stream.between(rest.span.from + ENDS.get(), rest.span.to - ENDS.get()))
        .filter(|range| range.len() > 1)
        .collect();
    SensorNoise::long_run_of(stream, &rests)
}

/// Standard deviation of a rest's mean along direction `u` of corrected specific force, m/s², from
/// the white noise within the rest.
pub(super) fn of_norm(rest: &Moments, base: &Base<f64>, u: &Vector3<f64>) -> f64 {
    let carried = base.t.transpose() * u;
    (carried.dot(&(rest.covariance * carried)) / rest.count as f64)
        .max(0.0)
        .sqrt()
}

/// Standard deviation of a component of the direction after each sound turn, rad: the gyroscope's
/// white noise over the turn, that of the bias from the two rests, and the accelerometer's at both
/// ends.
pub(super) fn of_turns(
    recording: &Recording,
    segmentation: &Segmentation,
    accelerometer: &Base<f64>,
    gyroscope_scale: f64,
    gravity: f64,
) -> Vec<f64> {
    let step = recording
        .gyroscope
        .as_ref()
        .and_then(Stream::median_step)
        .unwrap_or(0.0);
    let mean_variance = |m: &Moments| m.covariance.trace() / 3.0;
    let coloured = [&recording.accelerometer, &recording.gyroscope]
        .map(|stream| long_run(stream.as_ref(), segmentation).powi(2));
    segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter_map(|turn| {
            let ends = [
                segmentation.statics.get(turn.from)?,
                segmentation.statics.get(turn.from + 1)?,
            ];
            let mut rate = 0.0;
            let mut of_mean = 0.0;
            let mut ends_variance = 0.0;
            for end in ends {
                let (a, g) = (end.accelerometer?, end.gyroscope?);
                rate += 0.5 * mean_variance(&g);
                of_mean += 0.25 * mean_variance(&g) / g.count as f64;
                let scale = accelerometer.t.trace() / 3.0;
                ends_variance += mean_variance(&a) / a.count as f64 * (scale / gravity).powi(2);
            }
            let duration = turn.span.length();
            let walk = (rate * step * duration + of_mean * duration * duration)
                * coloured[1]
                * gyroscope_scale
                * gyroscope_scale;
            Some((walk + coloured[0] * ends_variance).sqrt())
        })
        .collect()
}
