//! A bias of the gyroscope that steps and stays.

use recording::averages::{NORMAL_OVER_MEDIAN, median};
use recording::intervals::{Moments, Span, StaticInterval};
use sensor::Sensor;

use super::change::{Change, Kind, Place};

findings::tuning! {
    /// Fewest static intervals.
    FEWEST: usize = 8;
    /// Fewest on either side of a step.
    SIDE: usize = 4;

    /// A step is so many times what the means of neighbouring intervals otherwise differ by.
    STANDS_OUT: f64 = 5.0;

    /// It stays: the levels of both sides differ by this share of it.
    STAYS: f64 = 0.6;
}

/// The largest step of the static means of each axis, where it stands out and stays.
pub(super) fn steps(rests: &[StaticInterval]) -> Vec<Change> {
    let with = rests.iter().enumerate();
    let with = with.filter_map(|(place, rest)| Some((place, rest.span, rest.gyroscope?)));
    let with: Vec<(usize, Span, Moments)> = with.collect();
    if with.len() < FEWEST.get() {
        return Vec::new();
    }
    (0..3).filter_map(|axis| of_axis(&with, axis)).collect()
}

fn of_axis(rests: &[(usize, Span, Moments)], axis: usize) -> Option<Change> {
    let mean: Vec<f64> = rests.iter().map(|(.., rate)| rate.mean[axis]).collect();
    let differences: Vec<f64> = mean.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let inner = SIDE.get() - 1..differences.len() + 1 - SIDE.get();
    let at = inner.max_by(|&a, &b| differences[a].abs().total_cmp(&differences[b].abs()))?;
    let step = differences[at];
    let others = differences.iter().enumerate().filter(|(k, _)| *k != at);
    let usual = NORMAL_OVER_MEDIAN * median(others.map(|(_, d)| d.abs()))?;
    let white = median(rests.iter().map(|(.., rate)| rate.white_of_mean()))?;
    let level = |side: &[f64]| median(side.iter().copied());
    let noise = usual.hypot(2f64.sqrt() * white);
    let levels = level(&mean[at + 1..])? - level(&mean[..=at])?;
    let stays = levels * step.signum() > STAYS.get() * step.abs();
    (step.abs() > STANDS_OUT.get() * noise && noise > 0.0 && stays).then(|| Change {
        kind: Kind::Bias(Sensor::Gyroscope, axis, step),
        place: Place {
            after: (rests[at].0, rests[at].1.to),
            before: (rests[at + 1].0, rests[at + 1].1.from),
        },
    })
}
