//! A static interval in which the device tilts all the way.

use nalgebra::Vector3;
use sensor::Base;

use crate::recording::Stream;

findings::tuning! {
    /// Pieces whose means show the slope.
    PIECES: usize = 12;

    /// Smaller tilts from begin to end are a table that gives way, rad (0.15°).
    LEAST: f64 = 2.6e-3;

    /// A slope stands out by so many of its standard errors: a hand sways, and does not go one way.
    BEYOND: f64 = 8.0;

    /// Between two pieces of a rest the direction of specific force differs by less, rad (4°): a boat rolls by it, a hand sways by it.
    MOST: f64 = 0.07;
}

/// The largest angle between the mean specific forces of the pieces of a stretch that is no rest whatever it is for, rad: a slow turn.
pub(super) fn turned_over(means: &[Vector3<f64>]) -> Option<f64> {
    let angles = means.iter().enumerate().flat_map(|(k, a)| {
        let others = means[k + 1..].iter();
        others.map(move |b| a.angle(b))
    });
    let largest = angles.fold(0.0, f64::max);
    (largest > MOST.get()).then_some(largest)
}

/// The means of [`PIECES`] of the samples, m/s²; `None` of fewer than two each.
pub(super) fn means(
    stream: &Stream,
    samples: std::ops::Range<usize>,
    base: &Base<f64>,
) -> Option<Vec<Vector3<f64>>> {
    let values = stream.values.get(samples)?;
    let length = values.len() / PIECES.get();
    if length < 2 {
        return None;
    }
    let mean = |piece: &[Vector3<f64>]| {
        base.correct(&(piece.iter().sum::<Vector3<f64>>() / length as f64))
    };
    Some(
        values
            .chunks_exact(length)
            .take(PIECES.get())
            .map(mean)
            .collect(),
    )
}

/// The tilt of specific force from begin to end, rad, where it is a steady one: a slope of
/// the means of twelve pieces that stands out of what they scatter about it.
pub(super) fn tilt(means: &[Vector3<f64>]) -> Option<f64> {
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
    (tilt > LEAST.get() && across > BEYOND.get() * error).then_some(tilt)
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

    fn pieces(stream: &Stream) -> Vec<Vector3<f64>> {
        means(stream, 0..500, &Base::identity()).unwrap()
    }

    #[test]
    fn a_steady_tilt_is_measured() {
        let found = tilt(&pieces(&stream(|t| 0.01 * t / 5.0))).unwrap();
        assert!((found - 0.01).abs() < 5e-4, "{found}");
    }

    #[test]
    fn a_slow_turn_is_no_rest_and_a_sway_of_two_degrees_may_be() {
        let over = |angle: fn(f64) -> f64| turned_over(&pieces(&stream(angle)));
        let turn = over(|t| 0.3 * ((t - 2.0) / 2.0).clamp(0.0, 1.0)).unwrap();
        assert!((turn - 0.3).abs() < 0.01, "{turn}");
        assert_eq!(over(|t| 0.03 * (2.0 * t).sin()), None);
    }

    #[test]
    fn sway_noise_and_a_small_tilt_are_none() {
        let none = |s: &Stream| tilt(&pieces(s)).is_none();
        assert!(none(&stream(|_| 0.0)));
        assert!(none(&stream(|t| 0.002 * t / 5.0)));
        assert!(none(&stream(|t| 0.01 * (2.0 * t).sin())));
    }
}
