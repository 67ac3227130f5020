//! Static intervals in which the device turns slowly, as on a surface that gives way or on a boat.
//!
//! Gravity moves by `Δu = u × θ` where the device turns by `θ` (rad, body frame), and the gyroscope reads `θ` and its bias. No error of one
//! sensor makes the other agree: a bias that moves turns no gravity, and an accelerometer that warms up turns no gyroscope.

use nalgebra::{DMatrix, DVector, Matrix3xX, Vector3};
use sensor::Sensor;

use crate::averages::median;
use crate::intervals::Segmentation;
use crate::readings::symptom::Symptom;
use crate::recording::{Recording, Stream};

findings::tuning! {
    /// Shortest interval that is looked at, s.
    SHORTEST: f64 = 1.5;
    /// Fewest intervals.
    FEWEST: usize = 5;

    /// Fewest intervals that tell a drift of the bias too.
    FEWEST_FOR_DRIFT: usize = 10;
}

/// Share of an interval whose mean is its begin, or its end; fewest samples of it.
const BLOCK: f64 = 0.2;

findings::tuning! {
    /// Fewest samples of such a share.
    FEWEST_SAMPLES: usize = 8;

    /// The direction of gravity moves where it does by so many of its standard deviations ...
    EVIDENT: f64 = 5.0;
    /// ... in this share of the intervals ...
    SHARE: f64 = 0.25;
    /// ... and in so many.
    FEWEST_EVIDENT: usize = 4;

    /// The sensors agree where what they see correlates so much ...
    CORRELATED: f64 = 0.8;
    /// ... and, with a gyroscope in rad/s, is the same up to this factor.
    SAME: f64 = 1.5;
}

/// An interval as both sensors see it.
struct Turned {
    interval: usize,
    /// Its begin, s, and its length, s.
    from: f64,
    length: f64,
    /// Direction of the specific force, unit.
    up: Vector3<f64>,
    /// Its change from the begin to the end, and the standard deviation of an axis of that, rad.
    change: Vector3<f64>,
    std: f64,
    /// The rotation that the gyroscope reads over the same time, in its unit by seconds, and that time, s.
    rotation: Vector3<f64>,
    time: f64,
}

/// The symptom of a device that turns in a quarter of the static intervals or more, where both sensors agree on it.
pub(in crate::readings) fn found(
    recording: &Recording,
    segmentation: &Segmentation,
) -> Option<Symptom> {
    let (force, rate) = (
        recording.accelerometer.as_ref()?,
        recording.gyroscope.as_ref()?,
    );
    let spans = segmentation.statics.iter().enumerate();
    let all: Vec<Turned> = spans
        .filter_map(|(k, interval)| turned(k, [interval.span.from, interval.span.to], force, rate))
        .collect();
    let moved = |one: &&Turned| one.change.norm() > EVIDENT.get() * one.std;
    let evident: Vec<&Turned> = all.iter().filter(moved).collect();
    if all.len() < FEWEST.get()
        || evident.len()
            < FEWEST_EVIDENT
                .get()
                .max((SHARE.get() * all.len() as f64).ceil() as usize)
    {
        return None;
    }
    let by_gyroscope = by_gyroscope(&all, recording.is_in_counts(Sensor::Gyroscope))?;
    let (mut seen, mut said, mut both) = (0.0, 0.0, 0.0);
    for (one, by_gyroscope) in all.iter().zip(&by_gyroscope) {
        let weight = one.std.powi(-2);
        seen += weight * one.change.norm_squared();
        said += weight * by_gyroscope.norm_squared();
        both += weight * one.change.dot(by_gyroscope);
    }
    let agrees = both > CORRELATED.get() * (seen * said).sqrt();
    agrees.then(|| Symptom::RestsTurn {
        intervals: evident.iter().map(|one| one.interval + 1).collect(),
        of: all.len(),
        angle: median(evident.iter().map(|one| one.change.norm())).unwrap_or(0.0),
        length: median(evident.iter().map(|one| one.length)).unwrap_or(0.0),
    })
}

/// An interval from `from` to `to` as both sensors see it.
fn turned(interval: usize, [from, to]: [f64; 2], force: &Stream, rate: &Stream) -> Option<Turned> {
    let length = to - from;
    let block = BLOCK * length;
    let first = &force.values[force.between(from, from + block)];
    let last = &force.values[force.between(to - block, to)];
    let samples = first.len().min(last.len());
    if length < SHORTEST.get() || samples < FEWEST_SAMPLES.get() {
        return None;
    }
    let whole = &force.values[force.between(from, to)];
    let strength = mean(whole).norm();
    let up = mean(whole) / strength;
    let change = (mean(last) - mean(first)) / strength;
    let steps = whole
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm_squared());
    let variance = steps.sum::<f64>() / (6.0 * (whole.len() - 1) as f64);
    // The gyroscope's rate under the weights that the difference of two such means has: up, level, down.
    let (mut sum, mut weights) = (Vector3::zeros(), 0.0);
    let own = rate.between(from, to);
    for (t, value) in rate.t[own.clone()].iter().zip(&rate.values[own]) {
        let weight = ((t - from).min(to - t) / block).clamp(0.0, 1.0);
        sum += value * weight;
        weights += weight;
    }
    let time = length - block;
    (weights > 0.0 && variance > 0.0 && strength > 0.0).then(|| Turned {
        interval,
        from,
        length,
        up,
        change: change - up * up.dot(&change),
        std: (2.0 * variance / samples as f64).sqrt() / strength,
        rotation: sum * (time / weights),
        time,
    })
}

/// The changes that the gyroscope says, `Δu = u × (k θ − (b + c t) T)`, with the scale `k`, the bias `b` and its drift `c` with which it
/// agrees best with the accelerometer; `None` where such a scale is none.
fn by_gyroscope(all: &[Turned], in_counts: bool) -> Option<Vec<Vector3<f64>>> {
    let (first, last) = (all.first()?.from, all.last()?.from);
    let usual = median(all.iter().map(|one| one.rotation.norm())).filter(|&usual| usual > 0.0)?;
    let with_drift = all.len() >= FEWEST_FOR_DRIFT.get();
    let count = if with_drift { 7 } else { 4 };
    let columns = |one: &Turned| {
        let up = one.up.cross_matrix();
        let mut columns = Matrix3xX::zeros(count);
        columns.set_column(0, &(up * one.rotation / usual));
        columns
            .fixed_columns_mut::<3>(1)
            .copy_from(&(up * one.time));
        if with_drift {
            let share = (one.from - first) / (last - first);
            let by_drift = up * (one.time * share);
            columns.fixed_columns_mut::<3>(4).copy_from(&by_drift);
        }
        columns
    };
    let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
    for one in all {
        let own = columns(one);
        normal += own.tr_mul(&own) * one.std.powi(-2);
        right += own.tr_mul(&one.change) * one.std.powi(-2);
    }
    let fitted = normal.cholesky()?.solve(&right);
    let scale = fitted[0] / usual;
    let is_one = (SAME.get().recip()..SAME.get()).contains(&scale);
    let said = |one: &Turned| columns(one) * &fitted;
    (is_one || (in_counts && scale > 0.0)).then(|| all.iter().map(said).collect())
}

fn mean(values: &[Vector3<f64>]) -> Vector3<f64> {
    values.iter().sum::<Vector3<f64>>() / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intervals::Span;

    /// What is found in twelve rests of 6 s in turned placements, in each of which the device turns by `turn` about a horizontal axis, and
    /// the gyroscope reads `drift` besides.
    fn in_rests(turn: f64, drift: f64) -> Option<Symptom> {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5) * 12f64.sqrt()
        };
        let mut noise = || Vector3::from_fn(|_, _| random());
        let bias = Vector3::new(0.01, -0.02, 0.005);
        let (mut force, mut rate, mut spans) = (Stream::default(), Stream::default(), Vec::new());
        for k in 0..12 {
            let from = 10.0 * f64::from(k);
            spans.push(Span {
                from,
                to: from + 6.0,
            });
            let up = noise().normalize();
            let axis = up.cross(&noise()).normalize();
            for i in 0..600 {
                let since = 0.01 * f64::from(i);
                let left = (-since / 3.0).exp();
                force.t.push(from + since);
                rate.t.push(from + since);
                force
                    .values
                    .push((up - up.cross(&axis) * (turn * left)) * 9.81 + noise() * 0.02);
                let turning = axis * (turn * left / 3.0);
                rate.values
                    .push(bias + turning + noise() * 0.001 + axis * (drift * since));
            }
        }
        let recording = Recording {
            accelerometer: Some(force),
            gyroscope: Some(rate),
            ..Recording::default()
        };
        let segmentation = Segmentation::from_spans(&recording, &spans, 1.0);
        found(&recording, &segmentation)
    }

    #[test]
    fn a_surface_that_gives_way_is_seen_by_both_sensors_and_a_drifting_bias_by_one() {
        let Some(Symptom::RestsTurn {
            intervals, angle, ..
        }) = in_rests(0.005, 0.0)
        else {
            panic!("not found");
        };
        assert_eq!(intervals.len(), 12);
        assert!((0.003..0.005).contains(&angle), "{angle}");
        assert_eq!(in_rests(0.0, 0.0), None);
        assert_eq!(in_rests(0.0, 0.001), None);
        // Only the accelerometer: a turn that the gyroscope does not read is none.
        assert_eq!(in_rests(0.005, 0.01), None);
    }
}
