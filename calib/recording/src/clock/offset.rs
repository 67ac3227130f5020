//! Time offset between the clocks of two sensors of one device, from the correlation of their motion.

use std::ops::Range;

use nalgebra::{DVectorView, Vector3};

use crate::recording::stream::Stream;

findings::tuning! {
    /// Length of the stretches whose spread is compared, s.
    STRETCH: f64 = 0.1;

    /// Offsets that are tried, in stretches, to either side.
    FARTHEST: usize = 600;
    /// The same where the drift is looked for.
    FARTHEST_OF_HALVES: usize = 100;
    /// Stretches of the two sensors that are compared, at most.
    MOST: usize = 20_000;

    /// Offsets below this are left to the fits, s.
    LEAST: f64 = 0.3;

    /// Correlation at the best offset.
    ALIKE: f64 = 0.6;
    /// By so much it is better than without an offset.
    BETTER: f64 = 0.1;

    /// Stretches between the best offset and another one that is not a part of its own peak.
    APART: u64 = 15;
    /// Another offset that is as good to this is not told from the best: a person turns a device at even intervals.
    AS_GOOD: f64 = 0.05;

    /// Stretches that suffice.
    ENOUGH: usize = 300;
}

/// By how much the stamps of `late` are later than those of `early` for the same motion, s, and another offset that may be the
/// true one as well; `None` where that is no more than a third of a second, and where the two do not move alike.
pub fn clock_offset(early: &Stream, late: &Stream) -> Option<(f64, Option<f64>)> {
    let (from, to) = common(early, late)?;
    let count = ((to - from) / STRETCH.get()) as usize;
    if count < ENOUGH.get() {
        return None;
    }
    let count = count.min(MOST.get());
    let of = |stream| Correlated::of(&activity(stream, from, count));
    let (a, b) = (of(early), of(late));
    // Offsets that leave too little to compare are not tried.
    let farthest = FARTHEST.get().min(count - ENOUGH.get() / 2) as i64;
    let all: Vec<(i64, f64)> = (-farthest..=farthest)
        .map(|lag| (lag, correlation(&a, &b, lag)))
        .collect();
    let best_of = |which: &dyn Fn(i64) -> bool| {
        let of = all.iter().filter(|(lag, _)| which(*lag));
        of.copied().max_by(|x, y| x.1.total_cmp(&y.1))
    };
    let (best, alike) = best_of(&|_| true)?;
    let (_, without) = best_of(&|lag| lag == 0)?;
    let other = best_of(&|lag| lag.abs_diff(best) > APART.get());
    let other = other.filter(|(_, other)| *other > alike - AS_GOOD.get());
    let found = best as f64 * STRETCH.get();
    let evident = alike > ALIKE.get() && alike > without + BETTER.get();
    (evident && found.abs() > LEAST.get())
        .then(|| (found, other.map(|(lag, _)| lag as f64 * STRETCH.get())))
}

/// The offsets of the first and the second half, s, and the middles of the halves; `None` where the two do not move alike in both.
pub(super) fn offsets_of_halves(early: &Stream, late: &Stream) -> Option<[(f64, f64); 2]> {
    let (from, to) = common(early, late)?;
    let half = (((to - from) / STRETCH.get() / 2.0) as usize).min(MOST.get());
    if half < ENOUGH.get() {
        return None;
    }
    let length = half as f64 * STRETCH.get();
    let offset = |begin: f64| {
        let of = |stream| Correlated::of(&activity(stream, begin, half));
        let (a, b) = (of(early), of(late));
        let farthest = FARTHEST_OF_HALVES.get() as i64;
        let all = (1 - farthest..farthest).map(|lag| (lag, correlation(&a, &b, lag)));
        let (best, peak) = all.max_by(|x, y| x.1.total_cmp(&y.1))?;
        (peak > ALIKE.get()).then_some((begin + 0.5 * length, STRETCH.get() * best as f64))
    };
    Some([offset(from)?, offset(from + length)?])
}

/// The time in which both sensors have samples.
pub(super) fn common(a: &Stream, b: &Stream) -> Option<(f64, f64)> {
    let from = a.t.first()?.max(*b.t.first()?);
    Some((from, a.t.last()?.min(*b.t.last()?)))
}

/// Logarithm of the spread of the readings in every stretch.
fn activity(stream: &Stream, from: f64, count: usize) -> Vec<f64> {
    let spread = |k: usize| {
        let begin = from + k as f64 * STRETCH.get();
        let values = &stream.values[stream.between(begin, begin + STRETCH.get())];
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

findings::tuning! {
    /// Activity with a smaller variance than this is the same throughout, up to rounding.
    STILL: f64 = 1e-9;
}

/// Activity of a sensor, ready to be correlated at many lags.
struct Correlated {
    /// Less its mean.
    values: Vec<f64>,
    /// Sums of the values before each place, and of their squares.
    sums: Vec<(f64, f64)>,
}

impl Correlated {
    fn of(activity: &[f64]) -> Self {
        let mean = activity.iter().sum::<f64>() / activity.len().max(1) as f64;
        let values: Vec<f64> = activity.iter().map(|v| v - mean).collect();
        let after = values.iter().scan((0.0, 0.0), |(sum, square), v| {
            *sum += v;
            *square += v * v;
            Some((*sum, *square))
        });
        let sums = std::iter::once((0.0, 0.0)).chain(after).collect();
        Self { values, sums }
    }

    /// The values at `places`, their sum and the sum of their squares.
    fn part(&self, places: Range<usize>) -> (DVectorView<'_, f64>, f64, f64) {
        let (before, after) = (self.sums[places.start], self.sums[places.end]);
        let values = &self.values[places];
        let values = DVectorView::from_slice(values, values.len());
        (values, after.0 - before.0, after.1 - before.1)
    }
}

/// Correlation of `a(k)` with `b(k + lag)`.
fn correlation(a: &Correlated, b: &Correlated, lag: i64) -> f64 {
    let (skipped, later) = match usize::try_from(lag) {
        Ok(later) => (0, later),
        Err(_) => (lag.unsigned_abs() as usize, 0),
    };
    let count = usize::min(
        a.values.len().saturating_sub(skipped),
        b.values.len().saturating_sub(later),
    );
    if count == 0 {
        return 0.0;
    }
    let n = count as f64;
    let (a, sum_a, aa) = a.part(skipped..skipped + count);
    let (b, sum_b, bb) = b.part(later..later + count);
    let aa = aa - sum_a * sum_a / n;
    let bb = bb - sum_b * sum_b / n;
    let ab = a.dot(&b) - sum_a * sum_b / n;
    if aa.min(bb) > STILL.get() * n {
        ab / (aa * bb).sqrt()
    } else {
        0.0
    }
}
