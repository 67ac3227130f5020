//! Readings that failed and were logged as zero, on every axis or on one.

use findings::{Finding, Findings, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::readings::dead_zone::is_left_out;
use crate::readings::of_sensor::least_beside_zero;
use crate::readings::symptom::axes_in_words;
use crate::recording::Stream;

findings::tuning! {
    /// Fewest of them.
    FEWEST: usize = 3;
    /// Failed reads stand alone or few together; a sensor with a dead zone reads zero as long as it rests.
    LONGEST: usize = 3;
    /// Share of the failed reads that stand so.
    ALONE: f64 = 0.9;
    /// Zeros are no chance where they come so many times as often as what chance makes as likely: on all axes as on one alone, on one axis as
    /// the readings next to zero.
    OFTEN: usize = 10;
    /// Largest share of such rows: of more nobody knows which are the readings.
    MOST: f64 = 0.7;
    /// Up to this share a line between the neighbours takes their place, and the rows stay where stamps of arrival are put in order by their
    /// number. More of such values would pass for noise that averages out.
    FEW: f64 = 0.1;
}

/// The stream without what is zero, on all axes or on one, among samples that are not.
pub(crate) fn without_failed_reads(
    name: &str,
    sensor: Sensor,
    mut stream: Stream,
    warnings: &mut Findings,
) -> Stream {
    let all = stream.len();
    let count = take_out_zeros(&mut stream);
    if count > 0 {
        warnings.push(found(name, sensor, count, all).detail("axes", "all axes"));
    }
    let of_axes = [0, 1, 2].map(|axis| bridge_zeros_of(&mut stream, axis));
    let failed = |axis: &usize| of_axes[*axis] > 0;
    let axes: Vec<usize> = (0..3).filter(failed).collect();
    if !axes.is_empty() {
        let found = found(name, sensor, of_axes.iter().sum(), all);
        let noun = if axes.len() == 1 { "axis" } else { "axes" };
        warnings.push(found.detail("axes", format!("{noun} {}", axes_in_words(&axes))));
    }
    stream
}

fn found(name: &str, sensor: Sensor, count: usize, all: usize) -> Finding {
    let failed = Finding::of(Kind::FAILED_READS).in_recording(name);
    let failed = failed.of_sensor(sensor).count("count", count);
    failed.number("share", count as f64 / all as f64, "share")
}

/// Takes the zeros out of a sensor's readings where those failed now and then: how many there were.
fn take_out_zeros(stream: &mut Stream) -> usize {
    let is_zero = |value: &Vector3<f64>| *value == Vector3::zeros();
    let count = stream.values.iter().filter(|value| is_zero(value)).count();
    let share = count as f64 / stream.len().max(1) as f64;
    if count < FEWEST.get() || share > MOST.get() || !fails(&stream.values) {
        return 0;
    }
    if share <= FEW.get() {
        let failed: Vec<bool> = stream.values.iter().map(is_zero).collect();
        (0..3).for_each(|axis| bridge(stream, axis, &failed));
        return count;
    }
    let mut kept = stream.values.iter().map(|value| !is_zero(value));
    stream.t.retain(|_| kept.next() != Some(false));
    stream.values.retain(|value| !is_zero(value));
    count
}

/// Puts a line in the place of the zeros of one axis where its readings failed now and then: how many there were.
fn bridge_zeros_of(stream: &mut Stream, axis: usize) -> usize {
    let is_zero = |value: &Vector3<f64>| value[axis] == 0.0;
    let count = stream.values.iter().filter(|value| is_zero(value)).count();
    if count < FEWEST.get()
        || count as f64 > FEW.get() * stream.len() as f64
        || !are_alone(&stream.values, is_zero)
    {
        return 0;
    }
    // Of steps as wide as the noise zero is one; a dead zone reads zero where its bias lies at the edge.
    let least = least_beside_zero(&stream.values, axis).unwrap_or(0.0);
    let is_next = |value: &&Vector3<f64>| !is_zero(value) && value[axis].abs() < 1.5 * least;
    let next = stream.values.iter().filter(is_next).count();
    if count <= OFTEN.get() * next || is_left_out(&stream.values, axis) {
        return 0;
    }
    let failed: Vec<bool> = stream.values.iter().map(is_zero).collect();
    bridge(stream, axis, &failed);
    count
}

/// Puts a line between the neighbours in the place of some readings of an axis.
fn bridge(stream: &mut Stream, axis: usize, failed: &[bool]) {
    let known: Vec<usize> = (0..stream.len()).filter(|&k| !failed[k]).collect();
    for pair in known.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let [a, b] = [from, to].map(|k| (stream.t[k], stream.values[k][axis]));
        for k in from + 1..to {
            let share = (stream.t[k] - a.0) / (b.0 - a.0);
            stream.values[k][axis] = a.1 + share * (b.1 - a.1);
        }
    }
    if let (Some(&first), Some(&last)) = (known.first(), known.last()) {
        let [first_value, last_value] = [first, last].map(|k| stream.values[k][axis]);
        stream.values[..first]
            .iter_mut()
            .for_each(|v| v[axis] = first_value);
        stream.values[last..]
            .iter_mut()
            .for_each(|v| v[axis] = last_value);
    }
}

/// Returns true if zeros on all axes stand alone and come far more often than those of one axis.
fn fails(values: &[Vector3<f64>]) -> bool {
    let is_zero = |value: &Vector3<f64>| *value == Vector3::zeros();
    let count = values.iter().filter(|value| is_zero(value)).count();
    let on_one = |axis: usize| {
        let partly = values.iter().filter(|value| !is_zero(value));
        partly.filter(|value| value[axis] == 0.0).count()
    };
    are_alone(values, is_zero) && (0..3).all(|axis| OFTEN.get() * on_one(axis) < count)
}

/// Returns true if nearly all runs of failed readings are short.
fn are_alone(values: &[Vector3<f64>], failed: impl Fn(&Vector3<f64>) -> bool) -> bool {
    let runs = values.chunk_by(|a, b| failed(a) == failed(b));
    let lengths: Vec<usize> = runs.filter(|run| failed(&run[0])).map(<[_]>::len).collect();
    let short = lengths
        .iter()
        .filter(|length| **length <= LONGEST.get())
        .count();
    short as f64 >= ALONE.get() * lengths.len() as f64
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
    fn zeros_of_one_axis_are_failed_reads_too() {
        let mut failing = stream(0.002, 1e-6, |_| false);
        for k in (7..2000).step_by(40) {
            failing.values[k].y = 0.0;
        }
        let mut warnings = Findings::new();
        let bridged = without_failed_reads("r", Sensor::Gyroscope, failing, &mut warnings);
        assert!(bridged.values.iter().all(|value| value.y != 0.0));
        let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        assert!(
            said.len() == 1 && said[0].contains("50 samples") && said[0].contains("axis y"),
            "{said:?}"
        );
    }

    #[test]
    fn zeros_of_coarse_steps_and_of_a_dead_zone_are_readings() {
        for step in [1e-3, 2e-3, 5e-3, 1e-2] {
            let mut coarse = stream(0.0, step, |_| false);
            assert_eq!(take_out_zeros(&mut coarse), 0, "{step}");
            assert_eq!(bridge_zeros_of(&mut coarse, 1), 0, "{step}");
        }
        // At rest for three seconds, then turning.
        let mut dead = stream(0.02, 1e-6, |k| k % 500 < 300);
        assert_eq!(take_out_zeros(&mut dead), 0);
    }
}
