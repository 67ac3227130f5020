//! Single rows that repeat the reading before them, of a sensor that was read before it had a new one.

use findings::{Finding, Findings, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::order_statistic::nth_smallest;
use crate::recording::{Frozen, Stream};

findings::tuning! {
    /// Longest run of equal readings that is filled in.
    LONGEST: usize = 4;

    /// The reading leaves a repeated one by more than so many steps on some axis: where it changes by one, it repeats because
    /// nothing moves.
    LEAP: f64 = 1.5;

    /// One difference of neighbours in a hundred is at most one step of the readings.
    STEP_SHARE: f64 = 0.01;

    /// Changes by one step at most on every axis, for each of which chance makes one repetition: the neighbours of a cell in three
    /// dimensions.
    NEIGHBOURS: f64 = 26.0;

    /// Repetitions are no chance where there are more than so many ...
    FEWEST: f64 = 20.0;
    /// ... and more than so many times what chance makes.
    OVER_CHANCE: f64 = 10.0;

    /// More repetitions than this share of the rows are those of a slower sensor.
    MOST: f64 = 0.45;
}

/// The stream with values on a smooth curve in place of single repetitions, where there are more of these than chance and the
/// resolution of the readings make.
pub(crate) fn without_stale(
    name: &str,
    sensor: Sensor,
    mut stream: Stream,
    frozen: &[Frozen],
    warnings: &mut Findings,
) -> Stream {
    let runs = stale_runs(&stream, frozen);
    let count: usize = runs.iter().map(|(first, next)| next - first - 1).sum();
    if count == 0 {
        return stream;
    }
    fill(&mut stream, &runs);
    warnings.push(
        Finding::of(Kind::READINGS_STALE)
            .in_recording(name)
            .of_sensor(sensor)
            .count("count", count)
            .number("share", count as f64 / stream.len() as f64, "share"),
    );
    stream
}

/// Puts values on a cubic through the two readings before and the two after in place of the repetitions: a line through one of each
/// misses the curvature of a hand's tremor by more than the noise.
fn fill(stream: &mut Stream, runs: &[(usize, usize)]) {
    let mut is_fresh = vec![true; stream.len()];
    for &(first, next) in runs {
        is_fresh[first + 1..next].fill(false);
    }
    let fresh: Vec<usize> = (0..stream.len()).filter(|&k| is_fresh[k]).collect();
    for &(first, next) in runs {
        let at = fresh.partition_point(|&k| k < first);
        let around = &fresh[at.saturating_sub(1)..(at + 3).min(fresh.len())];
        for k in first + 1..next {
            stream.values[k] = through(stream, around, stream.t[k]);
        }
    }
}

/// The polynomial through these rows at a time (Lagrange).
fn through(stream: &Stream, rows: &[usize], t: f64) -> Vector3<f64> {
    let of = |&row: &usize| {
        let others = rows.iter().filter(|other| **other != row);
        let parts = others.map(|&other| (t - stream.t[other]) / (stream.t[row] - stream.t[other]));
        stream.values[row] * parts.product::<f64>()
    };
    rows.iter().map(of).sum()
}

/// The first row of every run, and the first with another reading.
fn stale_runs(stream: &Stream, frozen: &[Frozen]) -> Vec<(usize, usize)> {
    let values = &stream.values;
    let repeated = values.windows(2).filter(|pair| pair[0] == pair[1]).count();
    if repeated as f64 <= FEWEST.get() {
        return Vec::new();
    }
    let Some(step) = steps(values) else {
        return Vec::new();
    };
    let leaps = |k: usize| {
        let by = values[k] - values[k - 1];
        (0..3).any(|axis| by[axis].abs() > LEAP.get() * step[axis])
    };
    let (mut runs, mut count, mut near) = (Vec::new(), 0, 0);
    let mut first = 0;
    for next in 1..values.len() {
        if values[next] == values[first] {
            continue;
        }
        let length = next - first;
        let stays = |fault: &Frozen| fault.is_between(stream.t[first], stream.t[next]);
        if first > 0 && length > 1 && length <= LONGEST.get() && leaps(first) && leaps(next) {
            count += length - 1;
            if !frozen.iter().any(stays) {
                runs.push((first, next));
            }
        }
        // A change by so little between two leaps.
        if length == 1 && first > 1 && !leaps(first) && leaps(first - 1) && leaps(next) {
            near += 1;
        }
        first = next;
    }
    let by_chance = f64::from(near) / NEIGHBOURS.get();
    let is_no_chance = count as f64 > FEWEST.get().max(OVER_CHANCE.get() * by_chance);
    let is_slower = count as f64 > MOST.get() * values.len() as f64;
    match is_no_chance && !is_slower {
        true => runs,
        false => Vec::new(),
    }
}

/// The step of the readings on every axis; `None` where an axis never changes.
fn steps(values: &[Vector3<f64>]) -> Option<[f64; 3]> {
    let of = |axis: usize| {
        let changes = values
            .windows(2)
            .map(|pair| (pair[1][axis] - pair[0][axis]).abs());
        let changes = changes.filter(|change| *change > 0.0);
        let rank = (STEP_SHARE.get() * changes.clone().count() as f64) as usize;
        nth_smallest(changes, rank)
    };
    Some([of(0)?, of(1)?, of(2)?])
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Readings in steps of so many standard deviations of the noise, of a device that turns and rests.
    fn readings(step: f64) -> Stream {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut noise = move || (0..12).map(|_| random.random::<f64>() - 0.5).sum::<f64>();
        let value = |k: usize| {
            let turn = if k % 900 < 300 { 60.0 } else { 0.0 };
            let rate = |phase: f64| turn * (k as f64 / 8.0 + phase).sin();
            let value = Vector3::new(rate(0.0), rate(1.0), rate(2.0)).map(|v| v + noise());
            value.map(|v| (v / step).round() * step)
        };
        Stream {
            t: (0..9000).map(|k| 0.01 * k as f64).collect(),
            values: (0..9000).map(value).collect(),
        }
    }

    fn stale(clean: &Stream, share: f64) -> Stream {
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let mut stale = clean.clone();
        for k in 1..clean.len() {
            if random.random::<f64>() < share {
                stale.values[k] = stale.values[k - 1];
            }
        }
        stale
    }

    fn filled(stream: &Stream) -> (Stream, usize) {
        let mut warnings = Findings::new();
        let gyroscope = Sensor::Gyroscope;
        let found = without_stale("a.csv", gyroscope, stream.clone(), &[], &mut warnings);
        let changed = found.values.iter().zip(&stream.values);
        (found.clone(), changed.filter(|(a, b)| a != b).count())
    }

    #[test]
    fn readings_that_repeat_by_their_resolution_are_left() {
        for step in [1e-3, 0.3, 1.0, 2.0, 4.0, 10.0] {
            assert_eq!(filled(&readings(step)).1, 0, "{step}");
        }
    }

    #[test]
    fn a_sensor_that_is_read_too_early_at_times_is_read_between() {
        for (step, share) in [(1e-3, 0.02), (0.3, 0.1), (1.0, 0.3)] {
            let clean = readings(step);
            let (found, count) = filled(&stale(&clean, share));
            assert!(
                count as f64 > 0.5 * share * clean.len() as f64,
                "{step}: {count}"
            );
            let error = |stream: &Stream| {
                let pairs = stream.values.iter().zip(&clean.values);
                pairs.map(|(a, b)| (a - b).norm_squared()).sum::<f64>()
            };
            assert!(error(&found) < 0.5 * error(&stale(&clean, share)), "{step}");
        }
    }
}
