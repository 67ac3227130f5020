//! The part of a rest that no motion leaks into.

use nalgebra::Vector3;

use crate::intervals::Span;
use crate::recording::{Stream, is_before};

/// Length of the means that are compared with those of the middle, s.
const BATCH: f64 = 0.1;
/// How far from either end motion is looked for, s, and the most of the rest that this may be.
const ENDS: f64 = 1.5;
const SHARE: f64 = 0.25;
/// A mean this many standard deviations off is motion.
const OFF: f64 = 4.0;
/// What is cut off in any case, s: motion that is still smaller than the noise.
const GUARD: f64 = 0.1;
/// Differences below this share of the reading are rounding.
const ROUNDING: f64 = 1e-12;

/// Cuts off what is not like the middle, in any of the streams.
pub fn quiet_part<'a>(streams: impl Iterator<Item = &'a Stream>, rest: Span) -> Span {
    let mut part = Span {
        from: rest.from + GUARD,
        to: rest.to - GUARD,
    };
    for stream in streams {
        let own = quiet_in(stream, rest);
        part.from = part.from.max(own.from);
        part.to = part.to.min(own.to);
    }
    part
}

fn quiet_in(stream: &Stream, rest: Span) -> Span {
    let ends = ENDS.min(SHARE * rest.length());
    let (first, last) = (rest.from + ends, rest.to - ends);
    let means = batches(stream, rest);
    let middle: Vec<_> = means
        .iter()
        .filter(|b| !is_before(b.0.from, first) && !is_before(last, b.0.to))
        .collect();
    let count = middle.len() as f64;
    let mean = middle.iter().map(|b| b.1).sum::<Vector3<f64>>() / count;
    let variance = middle
        .iter()
        .map(|b| (b.1 - mean).map(|d| d * d))
        .sum::<Vector3<f64>>()
        / (count - 1.0);
    let limit = variance.zip_map(&mean, |v, m| OFF * v.sqrt() + ROUNDING * (1.0 + m.abs()));
    let moves = |b: &&(Span, Vector3<f64>)| (0..3).any(|i| (b.1 - mean)[i].abs() > limit[i]);
    let from = means
        .iter()
        .filter(|b| is_before(b.0.from, first))
        .rfind(moves);
    let to = means.iter().filter(|b| is_before(last, b.0.to)).find(moves);
    Span {
        from: from.map_or(rest.from, |b| b.0.to) + GUARD,
        to: to.map_or(rest.to, |b| b.0.from) - GUARD,
    }
}

/// Means of the samples of neighbouring stretches.
fn batches(stream: &Stream, rest: Span) -> Vec<(Span, Vector3<f64>)> {
    (0..rest.stretches(BATCH))
        .filter_map(|k| {
            let span = Span {
                from: rest.from + k as f64 * BATCH,
                to: rest.from + (k + 1) as f64 * BATCH,
            };
            let samples = &stream.values[stream.between(span.from, span.to)];
            let mean = samples.iter().sum::<Vector3<f64>>() / samples.len() as f64;
            (!samples.is_empty()).then_some((span, mean))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slow_start_of_motion_is_cut_off_and_stillness_kept() {
        let t: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.01).collect();
        let values = t
            .iter()
            .map(|&t| {
                Vector3::new(
                    0.01 * (t * 3e3).sin() + (t - 9.3).max(0.0).powi(2),
                    0.0,
                    9.8,
                )
            })
            .collect();
        let stream = Stream { t, values };
        let part = quiet_part(
            [&stream].into_iter(),
            Span {
                from: 0.0,
                to: 10.0,
            },
        );
        assert!((0.1..0.5).contains(&part.from), "{part:?}");
        assert!((9.0..9.45).contains(&part.to), "{part:?}");
    }
}
