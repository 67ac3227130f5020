//! Rows decoded from memory that was never written.

use findings::{Finding, Kind};
use nalgebra::Vector3;

use crate::averages::median;
use crate::readings::of_sensor::FIRST_ROW;
use crate::recording::{Recording, Stream};

findings::tuning! {
    /// Fewest rows of a tail in both sensors; alone, a sensor needs more.
    FEWEST: usize = 8;
    /// Fewest rows of a tail in one sensor alone.
    FEWEST_ALONE: usize = 20;

    /// A force of less than a third or more than three times the usual is not gravity.
    NOT_GRAVITY: f64 = 3.0;
}

/// Cuts the rows at the end of which every sensor repeats one reading that no gravity gives: the same number
/// on all axes, or a norm far from the usual.
pub(crate) fn cut_erased_tail(recording: &mut Recording) -> Option<Finding> {
    let force = recording.accelerometer.as_ref()?;
    let tail = tail(&force.values);
    let start = force.len() - tail;
    let from = *force.t.get(start)?;
    let needed = match &recording.gyroscope {
        Some(_) => FEWEST.get(),
        None => FEWEST_ALONE.get(),
    };
    if tail < needed || start == 0 || !is_pattern(&force.values, start) {
        return None;
    }
    let turning = |stream: &Stream| {
        let rate = &stream.values;
        let constant = self::tail(rate);
        constant < FEWEST.get()
            || stream.t[rate.len() - constant] > from + crate::recording::INSTANT.get()
    };
    if recording.gyroscope.as_ref().is_some_and(turning) {
        return None;
    }
    let cut = |stream: &mut Option<Stream>| {
        if let Some(stream) = stream {
            let keep = stream.between(f64::NEG_INFINITY, from).end;
            stream.t.truncate(keep);
            stream.values.truncate(keep);
        }
    };
    cut(&mut recording.accelerometer);
    cut(&mut recording.gyroscope);
    let found = Finding::of(Kind::ERASED_TAIL)
        .from_time(from)
        .count("rows", tail)
        .count("first_row", start + FIRST_ROW);
    Some(found.in_recording(&recording.name))
}

/// Number of equal samples at the end.
fn tail(values: &[Vector3<f64>]) -> usize {
    let last = values.last();
    values.iter().rev().take_while(|v| Some(*v) == last).count()
}

fn is_pattern(values: &[Vector3<f64>], start: usize) -> bool {
    let v = values[start];
    let usual = median(values[..start].iter().map(Vector3::norm)).unwrap_or(0.0);
    let strange = v.norm() * NOT_GRAVITY.get() < usual || v.norm() > NOT_GRAVITY.get() * usual;
    strange || (v.x == v.y && v.y == v.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording(tail: Vector3<f64>) -> Recording {
        let t: Vec<f64> = (0..520).map(|k| 0.01 * f64::from(k)).collect();
        let stream = |base: Vector3<f64>| {
            let value = |k: usize| {
                if k < 500 {
                    base + Vector3::repeat((k * k % 97) as f64 * 1e-3)
                } else {
                    tail
                }
            };
            Some(Stream {
                t: t.clone(),
                values: (0..520).map(value).collect(),
            })
        };
        Recording {
            accelerometer: stream(Vector3::new(0.0, 0.0, 9.8)),
            gyroscope: stream(Vector3::zeros()),
            ..Recording::default()
        }
    }

    #[test]
    fn rows_of_ones_and_of_zeros_are_cut_at_their_first() {
        for value in [Vector3::repeat(-0.0012), Vector3::zeros()] {
            let mut cut = recording(value);
            let found = cut_erased_tail(&mut cut);
            let expected = Finding::of(Kind::ERASED_TAIL)
                .from_time(5.0)
                .count("rows", 20)
                .count("first_row", 502);
            assert_eq!(found, Some(expected.in_recording("")));
            assert_eq!(cut.accelerometer.unwrap().len(), 500);
            assert_eq!(cut.gyroscope.unwrap().len(), 500);
        }
    }

    #[test]
    fn a_quiet_end_is_left() {
        let mut kept = recording(Vector3::new(0.0, 0.0, 9.8));
        assert_eq!(cut_erased_tail(&mut kept), None);
        assert_eq!(kept.accelerometer.unwrap().len(), 520);
    }
}
