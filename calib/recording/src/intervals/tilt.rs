//! A static interval in which the device tilts all the way.

use nalgebra::Vector3;
use sensor::Base;

use crate::recording::Stream;

/// Pieces whose means show the slope.
const PIECES: usize = 12;

/// Smaller tilts from begin to end are a table that gives way, rad (0.15°).
const LEAST: f64 = 2.6e-3;

/// A slope stands out by so many of its standard errors: a hand sways, and does not go one way.
const BEYOND: f64 = 8.0;

/// The tilt of specific force from begin to end of the samples, rad, where it is a steady one: a slope of
/// the means of twelve pieces that stands out of what they scatter about it.
pub(super) fn tilt(
    stream: &Stream,
    samples: std::ops::Range<usize>,
    base: &Base<f64>,
) -> Option<f64> {
    let values = stream.values.get(samples)?;
    let length = values.len() / PIECES;
    if length < 2 {
        return None;
    }
    let means: Vec<Vector3<f64>> = values
        .chunks_exact(length)
        .take(PIECES)
        .map(|piece| base.correct(&(piece.iter().sum::<Vector3<f64>>() / length as f64)))
        .collect();
    let n = means.len() as f64;
    let mean = means.iter().sum::<Vector3<f64>>() / n;
    let place = |k: usize| (k as f64 + 0.5) / n - 0.5;
    let square: f64 = (0..means.len()).map(|k| place(k).powi(2)).sum();
    let weighted = means.iter().enumerate().map(|(k, m)| (m - mean) * place(k));
    let slope = weighted.sum::<Vector3<f64>>() / square;
    let left = means
        .iter()
        .enumerate()
        .map(|(k, m)| (m - mean - slope * place(k)).norm_squared());
    let error = (left.sum::<f64>() / (n - 2.0) / square).sqrt();
    let up = mean.normalize();
    let across = (slope - up * slope.dot(&up)).norm();
    let tilt = across / mean.norm();
    (tilt > LEAST && across > BEYOND * error).then_some(tilt)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream(angle: impl Fn(f64) -> f64) -> Stream {
        let t: Vec<f64> = (0..500).map(|k| 0.01 * f64::from(k)).collect();
        let value = |(k, &t): (usize, &f64)| {
            let (sin, cos) = angle(t).sin_cos();
            let noise = 0.02 * ((k * k % 997) as f64 / 498.0 - 1.0);
            Vector3::new(9.8 * sin + noise, noise, 9.8 * cos - noise)
        };
        let values = t.iter().enumerate().map(value).collect();
        Stream { t, values }
    }

    #[test]
    fn a_steady_tilt_is_measured() {
        let found = tilt(&stream(|t| 0.01 * t / 5.0), 0..500, &Base::identity()).unwrap();
        assert!((found - 0.01).abs() < 5e-4, "{found}");
    }

    #[test]
    fn sway_noise_and_a_small_tilt_are_none() {
        let none = |s: &Stream| tilt(s, 0..500, &Base::identity()).is_none();
        assert!(none(&stream(|_| 0.0)));
        assert!(none(&stream(|t| 0.002 * t / 5.0)));
        assert!(none(&stream(|t| 0.01 * (2.0 * t).sin())));
    }
}
