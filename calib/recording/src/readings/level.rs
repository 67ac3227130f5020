//! A specific force that has another size from a row on: another unit, another range, or other columns.

use nalgebra::Vector3;

use crate::averages::median;

findings::tuning! {
    /// Windows whose mean norm is looked at, at most.
    WINDOWS: usize = 2000;

    /// Shortest window, samples.
    SHORTEST: usize = 50;

    /// Fewest windows on either side of a change.
    SIDE: usize = 5;
    /// The same as one in so many of all.
    PART: usize = 20;

    /// Norms of one level lie within this share of their median: a hand does not add more on average.
    WITHIN: f64 = 0.25;

    /// Share of the windows that lie there on the side that has a level.
    ON_LEVEL: f64 = 0.97;
    /// Share of the windows that leave it on the other side.
    OFF_LEVEL: f64 = 0.9;

    /// Levels that differ by less than this factor may be of one unit.
    FACTOR: f64 = 1.5;
}

/// Lasting change in the norm of a sensor's readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LevelChange {
    /// The first sample of the new level.
    pub at: usize,
    /// Median norm before it.
    pub before: f64,
    /// Median norm from it on.
    pub after: f64,
}

/// The change of level of an accelerometer, whose norm is about that of gravity throughout; `None`
/// where there is none or where neither side has a level.
pub(crate) fn level_change(values: &[Vector3<f64>]) -> Option<LevelChange> {
    let length = (values.len() / WINDOWS.get()).max(SHORTEST.get());
    let mean = |window: &[Vector3<f64>]| {
        window.iter().map(Vector3::norm).sum::<f64>() / window.len() as f64
    };
    let levels: Vec<f64> = values.chunks_exact(length).map(mean).collect();
    let split = split(&levels)?;
    let (before, after) = (
        median(levels[..split].iter().copied())?,
        median(levels[split..].iter().copied())?,
    );
    let apart = after > FACTOR.get() * before || before > FACTOR.get() * after;
    let leaves = |side: &[f64], level: f64| {
        share(side, |v| !near(v, level, FACTOR.get() - 1.0)) >= OFF_LEVEL.get()
    };
    let (first, last) = levels.split_at(split);
    let of_one_level =
        |side: &[f64], level| share(side, |v| near(v, level, WITHIN.get())) >= ON_LEVEL.get();
    let changes = of_one_level(first, before) && leaves(last, before)
        || of_one_level(last, after) && leaves(first, after);
    (apart && changes).then(|| LevelChange {
        at: sharp(values, (split - 1) * length, length, before, after),
        before,
        after,
    })
}

fn near(value: f64, level: f64, share: f64) -> bool {
    (value - level).abs() <= share * level
}

fn share(values: &[f64], holds: impl Fn(f64) -> bool) -> f64 {
    values.iter().filter(|&&v| holds(v)).count() as f64 / values.len().max(1) as f64
}

/// The split of the logarithms into two means with the least sum of squares; `None` of too few.
fn split(levels: &[f64]) -> Option<usize> {
    let logs: Vec<f64> = levels
        .iter()
        .map(|v| v.max(f64::MIN_POSITIVE).ln())
        .collect();
    let total: f64 = logs.iter().sum();
    let n = logs.len();
    let side = SIDE.get().max(n / PART.get());
    let mut before = 0.0;
    let mut best = None;
    for (k, log) in logs.iter().enumerate() {
        if k >= side && k + side <= n {
            let (m, rest) = (k as f64, (n - k) as f64);
            let gain = before * before / m + (total - before) * (total - before) / rest;
            if best.is_none_or(|(most, _)| gain > most) {
                best = Some((gain, k));
            }
        }
        before += log;
    }
    best.map(|(_, k)| k)
}

/// The first sample of the new level, within two windows of `from`.
fn sharp(values: &[Vector3<f64>], from: usize, length: usize, before: f64, after: f64) -> usize {
    let middle = (before * after).sqrt();
    let is_new = |v: &Vector3<f64>| (v.norm() > middle) == (after > before);
    let end = (from + 3 * length).min(values.len());
    let last_old = values[from..end].iter().rposition(|v| !is_new(v));
    last_old.map_or(from, |k| (from + k + 1).min(values.len() - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gravity from all sides, pushed about.
    fn moved() -> Vec<Vector3<f64>> {
        let value = |k: usize| {
            let t = 0.01 * k as f64;
            let (s, c) = (0.3 * t).sin_cos();
            Vector3::new(9.8 * c, 9.8 * s, 2.0 * (5.0 * t).sin())
        };
        (0..6000).map(value).collect()
    }

    #[test]
    fn a_change_to_units_of_g_is_found_at_its_sample() {
        let mut values = moved();
        values[4100..].iter_mut().for_each(|v| *v /= 9.8);
        let found = level_change(&values).unwrap();
        assert_eq!(found.at, 4100);
        assert!((found.before / found.after / 9.8 - 1.0).abs() < 0.1);
    }

    #[test]
    fn columns_of_another_sensor_from_a_row_on_are_found() {
        let mut values = moved();
        for (k, v) in values.iter_mut().enumerate().skip(2500) {
            *v = Vector3::new(0.01, 0.02, (0.01 * k as f64).sin());
        }
        let found = level_change(&values).unwrap();
        assert!(found.at.abs_diff(2500) < 5, "{found:?}");
    }

    #[test]
    fn motion_is_no_change_of_level() {
        assert_eq!(level_change(&moved()), None);
        let mut shaken = moved();
        for (k, v) in shaken.iter_mut().enumerate().skip(3000) {
            v.x += 12.0 * (0.7 * k as f64).sin();
        }
        assert_eq!(level_change(&shaken), None);
        assert_eq!(level_change(&moved()[..300]), None);
    }
}
