//! Touches: short windows of a rest that shake more than the rest of the recording.

use nalgebra::Vector3;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::noise::{FLOOR, median};
use crate::intervals::Span;
use crate::recording::{INSTANT, Stream};

/// Length of a window, s.
const WINDOW: f64 = 0.25;

/// Touches are reported where chance would show one in so many recordings.
const CHANCE: f64 = 0.001;

/// A step between samples longer than this many median steps is a gap.
const GAP_STEPS: f64 = 5.0;

/// A window of a stretch that shakes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shake {
    /// The stretch, by its place among those given.
    pub stretch: usize,
    /// When it shakes most, s.
    pub time: f64,
    /// Standard deviation there over the usual.
    pub ratio: f64,
}

/// The stretches of rest with a window that chance does not explain, and its worst window.
///
/// A window's sum of squares about the mean of its stretch, over the usual variance per axis, is χ² of
/// its number of samples. The usual variance is the median over all windows, so that neither
/// colour nor a few touches move it.
pub fn shakes(stream: &Stream, stretches: &[Span]) -> Vec<Shake> {
    let Some(step) = stream.median_step().filter(|s| *s > 0.0) else {
        return Vec::new();
    };
    let count = (((WINDOW + INSTANT) / step).round() as usize).max(4);
    let windows: Vec<Window> = stretches
        .iter()
        .enumerate()
        .flat_map(|(k, span)| windows(stream, k, *span, count))
        .collect();
    let usual = Vector3::from_fn(|axis, _| {
        let all: Vec<f64> = windows.iter().map(|w| w.squares[axis] / w.count).collect();
        median(&all).unwrap_or(0.0).max(FLOOR * FLOOR)
    });
    if windows.is_empty() {
        return Vec::new();
    }
    // The median of χ²_n / n lies below 1 by this much.
    let centre = |n: f64| (1.0 - 2.0 / (9.0 * n)).powi(3);
    let level = CHANCE / windows.len() as f64;
    let mut found: Vec<Shake> = Vec::new();
    for window in &windows {
        let n = window.count;
        let sum: f64 = (0..3)
            .map(|i| window.squares[i] / usual[i] * centre(n))
            .sum();
        let Ok(law) = ChiSquared::new(3.0 * n) else {
            continue;
        };
        if law.sf(sum) >= level {
            continue;
        }
        let shake = Shake {
            stretch: window.stretch,
            time: window.time,
            ratio: (sum / (3.0 * n)).sqrt(),
        };
        match found.iter_mut().find(|f| f.stretch == shake.stretch) {
            Some(known) if known.ratio >= shake.ratio => {}
            Some(known) => *known = shake,
            None => found.push(shake),
        }
    }
    found
}

struct Window {
    stretch: usize,
    time: f64,
    count: f64,
    squares: Vector3<f64>,
}

/// The windows of `count` samples in a stretch.
fn windows(stream: &Stream, stretch: usize, span: Span, count: usize) -> Vec<Window> {
    let range = stream.between(span.from, span.to);
    let values = &stream.values[range.clone()];
    let mean = values.iter().sum::<Vector3<f64>>() / values.len().max(1) as f64;
    values
        .chunks_exact(count)
        .enumerate()
        .map(|(k, part)| Window {
            stretch,
            time: stream.t[range.start + k * count + count / 2],
            count: count as f64,
            squares: part.iter().map(|v| (v - mean).map(|d| d * d)).sum(),
        })
        .collect()
}

/// The gaps in each of some rests.
pub fn gaps(stream: &Stream, rests: &[Span]) -> Vec<Vec<Span>> {
    let Some(step) = stream.median_step() else {
        return vec![Vec::new(); rests.len()];
    };
    let of = |rest: &Span| {
        stream.t[stream.between(rest.from, rest.to)]
            .windows(2)
            .filter(|w| w[1] - w[0] > GAP_STEPS * step + INSTANT)
            .map(|w| Span {
                from: w[0],
                to: w[1],
            })
            .collect()
    };
    rests.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::Spec;

    fn eight_seconds(stream: &Stream) -> Vec<Span> {
        let end = stream.t[stream.len() - 1];
        (0..(end / 8.0) as usize)
            .map(|k| Span {
                from: 8.0 * k as f64,
                to: 8.0 * (k + 1) as f64,
            })
            .collect()
    }

    #[test]
    fn a_touch_is_found_where_it_was_and_nothing_elsewhere() {
        let mut stream = Spec::still(4, 400.0)
            .run()
            .unwrap()
            .recording
            .accelerometer
            .unwrap();
        let stretches = eight_seconds(&stream);
        assert_eq!(shakes(&stream, &stretches), []);
        for k in 10_000..10_050 {
            stream.values[k].y += 0.06 * (k as f64 * 0.3).sin();
        }
        let found = shakes(&stream, &stretches);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].stretch, 12);
        assert!((found[0].time - 100.2).abs() < 0.5);
    }
}
