//! Search for the quietest stretches of a recording.

use crate::intervals::{Moments, Span};
use crate::recording::{Recording, Stream};

findings::tuning! {
    /// Length of the stretches, s.
    LENGTH: f64 = 1.0;
}

/// A stretch and what moves in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quiet {
    /// Begin and end by the stamps, s.
    pub span: Span,
    /// Spread of the accelerometer, over its axes; in the unit of the readings.
    pub force: Option<f64>,
    /// Spread of the gyroscope.
    pub rate: Option<f64>,
}

/// The quietest stretches of a second, at most `count`, quietest first: by the gyroscope where there is
/// one.
pub fn quietest(recording: &Recording, count: usize) -> Vec<Quiet> {
    let gyroscope = recording.gyroscope.as_ref();
    let Some(stream) = gyroscope.or(recording.accelerometer.as_ref()) else {
        return Vec::new();
    };
    let (Some(&first), Some(&last)) = (stream.t.first(), stream.t.last()) else {
        return Vec::new();
    };
    let spread = |stream: &Option<Stream>, span: Span| {
        let stream = stream.as_ref()?;
        let samples = &stream.values[stream.between(span.from, span.to)];
        Some(Moments::of(samples).filter(|m| m.count > 2)?.std().norm())
    };
    let whole = Span {
        from: first,
        to: last,
    };
    let mut all: Vec<Quiet> = (0..whole.stretches(LENGTH.get()).min(stream.len()))
        .map(|k| {
            let from = first + LENGTH.get() * k as f64;
            let span = Span {
                from,
                to: from + LENGTH.get(),
            };
            Quiet {
                span,
                force: spread(&recording.accelerometer, span),
                rate: spread(&recording.gyroscope, span),
            }
        })
        .collect();
    let level = |quiet: &Quiet| quiet.rate.or(quiet.force).unwrap_or(f64::INFINITY);
    all.sort_by(|a, b| level(a).total_cmp(&level(b)));
    all.truncate(count);
    all
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn the_quiet_second_comes_first() {
        let t: Vec<f64> = (0..1000).map(|k| 0.01 * f64::from(k)).collect();
        let size = |k: usize| if (400..500).contains(&k) { 0.01 } else { 1.0 };
        let values = (0..1000).map(|k| Vector3::repeat(size(k) * (k as f64).sin()));
        let recording = Recording {
            gyroscope: Some(Stream {
                values: values.collect(),
                t,
            }),
            ..Recording::default()
        };
        let found = quietest(&recording, 2);
        assert!((found[0].span.from - 4.0).abs() < 1e-9 && found.len() == 2);
        assert!(found[0].force.is_none());
    }
}
