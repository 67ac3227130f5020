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

/// The stream without the samples that are zero on all axes among others that are not.
pub(crate) fn without_failed_reads(
    name: &str,
    sensor: Sensor,
    mut stream: Stream,
    warnings: &mut Findings,
) -> Stream {
    let all = stream.len();
    let count = drop_zeros(&mut stream);
    if count > 0 {
        let failed = Finding::of(Kind::FailedReads).in_recording(name);
        let failed = failed.of_sensor(sensor).count("count", count);
        warnings.push(failed.number("share", count as f64 / all as f64, "share"));
    }
    stream
}

/// Drops the zeros of a sensor whose readings failed now and then: how many there were.
fn drop_zeros(stream: &mut Stream) -> usize {
    let is_zero = |value: &Vector3<f64>| *value == Vector3::zeros();
    let count = stream.values.iter().filter(|value| is_zero(value)).count();
    let many = MOST * stream.len() as f64;
    if count < FEWEST || count as f64 > many || !fails(&stream.values) {
        return 0;
    }
    let mut kept = stream.values.iter().map(|value| !is_zero(value));
    stream.t.retain(|_| kept.next() != Some(false));
    stream.values.retain(|value| !is_zero(value));
    count
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
            assert_eq!(drop_zeros(&mut failing), 2000 / every, "{every}");
            assert_eq!(failing.t.len(), failing.values.len());
            assert!(failing.values.iter().all(|value| value.norm() > 0.0));
        }
    }

    #[test]
    fn zeros_of_coarse_steps_and_of_a_dead_zone_are_readings() {
        for step in [1e-3, 2e-3, 5e-3, 1e-2] {
            let mut coarse = stream(0.0, step, |_| false);
            assert_eq!(drop_zeros(&mut coarse), 0, "{step}");
        }
        // At rest for three seconds, then turning.
        let mut dead = stream(0.02, 1e-6, |k| k % 500 < 300);
        assert_eq!(drop_zeros(&mut dead), 0);
    }
}
