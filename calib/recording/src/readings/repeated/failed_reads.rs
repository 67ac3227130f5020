//! Readings that failed and were logged as zero on every axis.

use findings::{Finding, Findings, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::recording::Stream;

/// Fewest of them.
const FEWEST: usize = 3;
/// Failed reads stand alone or few together; a sensor with a dead zone reads zero as long as it rests.
const LONGEST: usize = 3;
const ALONE: f64 = 0.9;
/// Of a sensor that reads zero by chance one axis alone does so far more often than all three.
const ON_ALL_AXES: usize = 10;
/// Of more rows nobody knows which are the readings.
const MOST: f64 = 0.7;
/// Up to this share a line between the neighbours takes their place, and the rows stay where stamps of arrival are put in order by their
/// number. More of such values would pass for noise that averages out.
const FEW: f64 = 0.1;

/// The stream without what is zero on all axes among samples that are not.
pub(crate) fn without_failed_reads(
    name: &str,
    sensor: Sensor,
    mut stream: Stream,
    warnings: &mut Findings,
) -> Stream {
    let all = stream.len();
    let count = take_out_zeros(&mut stream);
    if count > 0 {
        let failed = Finding::of(Kind::FailedReads).in_recording(name);
        let failed = failed.of_sensor(sensor).count("count", count);
        warnings.push(failed.number("share", count as f64 / all as f64, "share"));
    }
    stream
}

/// Takes the zeros out of a sensor's readings where those failed now and then: how many there were.
fn take_out_zeros(stream: &mut Stream) -> usize {
    let is_zero = |value: &Vector3<f64>| *value == Vector3::zeros();
    let count = stream.values.iter().filter(|value| is_zero(value)).count();
    let share = count as f64 / stream.len().max(1) as f64;
    if count < FEWEST || share > MOST || !fails(&stream.values) {
        return 0;
    }
    if share <= FEW {
        bridge(stream, is_zero);
        return count;
    }
    let mut kept = stream.values.iter().map(|value| !is_zero(value));
    stream.t.retain(|_| kept.next() != Some(false));
    stream.values.retain(|value| !is_zero(value));
    count
}

/// Puts a line between the neighbours in the place of some readings.
fn bridge(stream: &mut Stream, is_missing: impl Fn(&Vector3<f64>) -> bool) {
    let known: Vec<usize> = (0..stream.len())
        .filter(|&k| !is_missing(&stream.values[k]))
        .collect();
    for pair in known.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let [a, b] = [from, to].map(|k| (stream.t[k], stream.values[k]));
        for k in from + 1..to {
            let share = (stream.t[k] - a.0) / (b.0 - a.0);
            stream.values[k] = a.1.lerp(&b.1, share);
        }
    }
    if let (Some(&first), Some(&last)) = (known.first(), known.last()) {
        let [first_value, last_value] = [first, last].map(|k| stream.values[k]);
        stream.values[..first].fill(first_value);
        stream.values[last..].fill(last_value);
    }
}

fn fails(values: &[Vector3<f64>]) -> bool {
    let zeros = |value: &Vector3<f64>| value.iter().filter(|v| **v == 0.0).count();
    let runs = values.chunk_by(|a, b| (zeros(a) == 3) == (zeros(b) == 3));
    let lengths: Vec<usize> = runs
        .filter(|run| zeros(&run[0]) == 3)
        .map(<[_]>::len)
        .collect();
    let short = lengths.iter().filter(|length| **length <= LONGEST).count();
    let count: usize = lengths.iter().sum();
    let on_one = |axis: usize| {
        let partly = values.iter().filter(|value| zeros(value) < 3);
        partly.filter(|value| value[axis] == 0.0).count()
    };
    let is_alone = short as f64 >= ALONE * lengths.len() as f64;
    is_alone && (0..3).all(|axis| ON_ALL_AXES * on_one(axis) < count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings in steps of `step`, at rest about `bias`, that an index spoils.
    fn stream(bias: f64, step: f64, spoils: impl Fn(usize) -> bool) -> Stream {
        let noise =
            |k: usize| ((k as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40) as f64 / 8.4e6 - 1.0;
        let value = |k: usize| match spoils(k) {
            true => Vector3::zeros(),
            false => Vector3::from_fn(|axis, _| {
                ((bias + 3e-3 * noise(3 * k + axis)) / step).round() * step
            }),
        };
        Stream {
            t: (0..2000).map(|k| 0.01 * k as f64).collect(),
            values: (0..2000).map(value).collect(),
        }
    }

    #[test]
    fn zeros_among_readings_are_failed_reads_however_many_up_to_half() {
        for every in [2, 20, 200] {
            let mut failing = stream(0.02, 1e-6, |k| k % every == 1);
            assert_eq!(take_out_zeros(&mut failing), 2000 / every, "{every}");
            assert_eq!(failing.t.len(), failing.values.len());
            assert!(failing.values.iter().all(|value| value.norm() > 0.0));
        }
    }

    #[test]
    fn zeros_of_coarse_steps_and_of_a_dead_zone_are_readings() {
        for step in [1e-3, 2e-3, 5e-3, 1e-2] {
            let mut coarse = stream(0.0, step, |_| false);
            assert_eq!(take_out_zeros(&mut coarse), 0, "{step}");
        }
        // At rest for three seconds, then turning.
        let mut dead = stream(0.02, 1e-6, |k| k % 500 < 300);
        assert_eq!(take_out_zeros(&mut dead), 0);
    }
}
