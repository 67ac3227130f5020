//! Time offset between the clocks of two sensors of one device, from the correlation of their motion.

use nalgebra::Vector3;

use crate::recording::stream::Stream;

/// Length of the stretches whose spread is compared, s.
const STRETCH: f64 = 0.1;

/// Offsets that are tried, in stretches, to either side; where the drift is looked for it is less.
const FARTHEST: usize = 600;
const FARTHEST_OF_HALVES: usize = 100;
/// Stretches of the two sensors that are compared, at most.
const MOST: usize = 20_000;

/// Offsets below this are left to the fits, s.
const LEAST: f64 = 0.3;

/// The correlation at the best offset, and how much better it must be than without one.
const ALIKE: f64 = 0.6;
const BETTER: f64 = 0.1;

/// Another offset, farther from the best than so many stretches, that is as good to this is not told from it: a person turns
/// a device at even intervals.
const APART: u64 = 15;
const AS_GOOD: f64 = 0.05;

/// Stretches that suffice.
const ENOUGH: usize = 300;

/// By how much the stamps of `late` are later than those of `early` for the same motion, s, and another offset that may be the
/// true one as well; `None` where that is no more than a third of a second, and where the two do not move alike.
pub fn clock_offset(early: &Stream, late: &Stream) -> Option<(f64, Option<f64>)> {
    let (from, to) = common(early, late)?;
    let count = ((to - from) / STRETCH) as usize;
    if count < ENOUGH {
        return None;
    }
    let count = count.min(MOST);
    let (a, b) = (activity(early, from, count), activity(late, from, count));
    // Offsets that leave too little to compare are not tried.
    let farthest = FARTHEST.min(count - ENOUGH / 2) as i64;
    let all: Vec<(i64, f64)> = (-farthest..=farthest)
        .map(|lag| (lag, correlation(&a, &b, lag)))
        .collect();
    let best_of = |which: &dyn Fn(i64) -> bool| {
        let of = all.iter().filter(|(lag, _)| which(*lag));
        of.copied().max_by(|x, y| x.1.total_cmp(&y.1))
    };
    let (best, alike) = best_of(&|_| true)?;
    let (_, without) = best_of(&|lag| lag == 0)?;
    let other = best_of(&|lag| lag.abs_diff(best) > APART);
    let other = other.filter(|(_, other)| *other > alike - AS_GOOD);
    let found = best as f64 * STRETCH;
    let evident = alike > ALIKE && alike > without + BETTER;
    (evident && found.abs() > LEAST).then(|| (found, other.map(|(lag, _)| lag as f64 * STRETCH)))
}

/// The offsets of the first and the second half, s, and the middles of the halves; `None` where the two do not move alike in both.
pub(super) fn offsets_of_halves(early: &Stream, late: &Stream) -> Option<[(f64, f64); 2]> {
    let (from, to) = common(early, late)?;
    let half = (((to - from) / STRETCH / 2.0) as usize).min(MOST);
    if half < ENOUGH {
        return None;
    }
    let length = half as f64 * STRETCH;
    let offset = |begin: f64| {
        let (a, b) = (activity(early, begin, half), activity(late, begin, half));
        let farthest = FARTHEST_OF_HALVES as i64;
        let all = (1 - farthest..farthest).map(|lag| (lag, correlation(&a, &b, lag)));
        let (best, peak) = all.max_by(|x, y| x.1.total_cmp(&y.1))?;
        (peak > ALIKE).then_some((begin + 0.5 * length, STRETCH * best as f64))
    };
    Some([offset(from)?, offset(from + length)?])
}

/// The time in which both sensors have samples; `None` where they share their stamps.
pub(super) fn common(a: &Stream, b: &Stream) -> Option<(f64, f64)> {
    if a.t == b.t {
        return None;
    }
    let from = a.t.first()?.max(*b.t.first()?);
    Some((from, a.t.last()?.min(*b.t.last()?)))
}

/// Logarithm of the spread of the readings in every stretch.
fn activity(stream: &Stream, from: f64, count: usize) -> Vec<f64> {
    let spread = |k: usize| {
        let begin = from + k as f64 * STRETCH;
        let values = &stream.values[stream.between(begin, begin + STRETCH)];
        let mean = values.iter().sum::<Vector3<f64>>() / values.len().max(1) as f64;
        let square: f64 = values.iter().map(|v| (v - mean).norm_squared()).sum();
        0.5 * (square / values.len().max(1) as f64)
            .max(f64::MIN_POSITIVE)
            .ln()
    };
    let mut all: Vec<f64> = (0..count).map(spread).collect();
    // Stretches without spread are held at the usual least, so that an empty one counts no more than a quiet one.
    let mut sorted = all.clone();
    sorted.sort_by(f64::total_cmp);
    let least = sorted[count / 10];
    all.iter_mut().for_each(|v| *v = v.max(least));
    all
}

/// Correlation of `a(k)` with `b(k + lag)`.
fn correlation(a: &[f64], b: &[f64], lag: i64) -> f64 {
    let pairs: Vec<(f64, f64)> = (0..a.len())
        .filter_map(|k| {
            let place = usize::try_from(k as i64 + lag).ok()?;
            Some((a[k], *b.get(place)?))
        })
        .collect();
    let n = pairs.len() as f64;
    let (sum_a, sum_b) = pairs
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0, y + p.1));
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in &pairs {
        let (a, b) = (a - sum_a / n, b - sum_b / n);
        (aa, bb, ab) = (aa + a * a, bb + b * b, ab + a * b);
    }
    if aa * bb > 0.0 {
        ab / (aa * bb).sqrt()
    } else {
        0.0
    }
}
