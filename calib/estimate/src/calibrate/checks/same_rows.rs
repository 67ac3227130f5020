//! Rows that come again, in two recordings or in one, whatever static intervals they are cut into.

use std::collections::HashMap;

use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::{Error, Recording, Stream};
use sensor::Sensor;

use super::twice::without_copies;

/// Steps from row to row that are compared at once, ...
const STEPS: usize = 64;

/// ... where the readings turn back so often within them, on all axes together: noise does twice as often, and readings that rise
/// smoothly or do not change are alike by chance. Noise has the same directions of so many steps in one of 10²⁰ pairs.
const REVERSALS: usize = STEPS;

findings::tuning! {
    /// So many times in one order they are the same data, and not a few rows that a logger wrote twice.
    RUNS: usize = 8;

    /// One recording may have every second to so many-th row of another.
    THINNED: usize = 10;
}

/// Factor of the hash, odd.
const FACTOR: u64 = 0x9E37_79B9_7F4A_7C15;

/// Refuses recordings of which one repeats readings of another, or a part of its own: where they go up and down alike from row to row,
/// be it for less than the static intervals that tell it.
///
/// # Errors
/// The two and where the same data are.
pub fn no_rows_come_again<'a>(
    recordings: impl IntoIterator<Item = &'a Recording>,
) -> Result<(), Error> {
    // A long recording is there once for each of its parts.
    let (all, _) = without_copies(recordings);
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let streams = all.iter().map(|recording| recording.stream(sensor));
        let streams: Vec<Option<&Stream>> = streams.collect();
        let found = same_readings(&streams).or_else(|| thinned_readings(&streams));
        let Some([first, second]) = found else {
            continue;
        };
        let time = |(k, row): (usize, usize)| streams[k].map_or(0.0, |stream| stream.t[row]);
        let other = match first.0 == second.0 {
            true => "itself",
            false => &all[first.0].name,
        };
        return Err(Error::input(
            Finding::of(Kind::READINGS_TWICE)
                .in_recording(&all[second.0].name)
                .of_sensor(sensor)
                .from_time(time(second))
                .detail("other", other)
                .detail("time", format!("{:.2} s", time(first))),
        ));
    }
    Ok(())
}

/// Stream and row.
type Place = (usize, usize);

/// Where [`STEPS`] steps of known hash are, of every so many-th row.
type Known = HashMap<u64, Place>;

/// The place of readings, and that where they are again.
fn same_readings(streams: &[Option<&Stream>]) -> Option<[Place; 2]> {
    let mut known = Known::new();
    for (k, stream) in streams.iter().enumerate() {
        let steps = stream.map_or_else(Vec::new, |stream| steps(stream.values.iter()));
        note(&mut known, k, &steps);
        if let Some((from, to)) = again(&known, k, &steps) {
            return Some([from, (k, to)]);
        }
    }
    None
}

/// Where readings are of which another recording has every second to [`THINNED`]th row, and where these are.
fn thinned_readings(streams: &[Option<&Stream>]) -> Option<[Place; 2]> {
    if streams.len() < 2 {
        return None;
    }
    let mut known = Known::new();
    for (k, stream) in streams.iter().enumerate() {
        note(
            &mut known,
            k,
            &stream.map_or_else(Vec::new, |stream| steps(stream.values.iter())),
        );
    }
    for (k, stream) in streams.iter().enumerate() {
        let Some(stream) = stream else { continue };
        // A recording that is like itself so is what a machine shakes.
        let others = known.iter().filter(|(_, place)| place.0 != k);
        let others: Known = others.map(|(hash, place)| (*hash, *place)).collect();
        for (every, first) in
            (2..=THINNED.get()).flat_map(|every| (0..every).map(move |k| (every, k)))
        {
            let rows = stream.values.iter().skip(first).step_by(every);
            if let Some((from, to)) = again(&others, k, &steps(rows)) {
                return Some([(k, first + every * to), from]);
            }
        }
    }
    None
}

/// Notes where the runs of a stream are.
fn note(known: &mut Known, k: usize, steps: &[(u8, u8)]) {
    for (row, hash) in runs(steps).filter(|(row, _)| row % STEPS == 0) {
        known.entry(hash).or_insert((k, row));
    }
}

/// Where one of the known runs is, and the row of these steps of a stream from which on it is there again.
fn again(known: &Known, k: usize, steps: &[(u8, u8)]) -> Option<(Place, usize)> {
    let mut again = HashMap::<Place, (usize, [usize; 2])>::new();
    let mut all = 0;
    for (row, hash) in runs(steps) {
        let Some(&(other, before)) = known.get(&hash) else {
            continue;
        };
        if other == k && before + STEPS > row {
            continue;
        }
        all += 1;
        let shift = row.wrapping_sub(before);
        // What comes a third time as far behind is one placement again and again, or what a machine shakes.
        if other == k && is_again(steps, row, shift) {
            continue;
        }
        let (count, [from, to]) = again.entry((other, shift)).or_insert((0, [before, row]));
        *count += 1;
        // The same again and again is so at any distance.
        if *count >= RUNS.get() && 2 * *count > all {
            return Some(((other, *from), *to));
        }
    }
    None
}

/// Returns true if the steps from a row on are there once more so many rows behind.
fn is_again(steps: &[(u8, u8)], row: usize, shift: usize) -> bool {
    let from = |row: usize| steps.get(row..row + STEPS);
    from(row).is_some_and(|own| from(row + shift) == Some(own))
}

/// The directions of the steps from row to row as numbers below 27, and on how many axes they turn back.
fn steps<'a>(rows: impl Iterator<Item = &'a Vector3<f64>> + Clone) -> Vec<(u8, u8)> {
    let mut last = [0; 3];
    let numbered = directions(rows).map(|direction| {
        let mut turned = 0;
        for (last, own) in last.iter_mut().zip(direction) {
            turned += u8::from(own * *last < 0);
            if own != 0 {
                *last = own;
            }
        }
        let code = direction.iter().fold(0, |code, own| 3 * code + own + 1);
        (code.unsigned_abs(), turned)
    });
    numbered.collect()
}

/// The rows from which on [`STEPS`] steps turn back often, with a hash of these.
fn runs(steps: &[(u8, u8)]) -> impl Iterator<Item = (usize, u64)> {
    let oldest = (0..STEPS).fold(1, |power: u64, _| power.wrapping_mul(FACTOR));
    let (mut hash, mut turned) = (0_u64, 0);
    let hashes = steps.iter().enumerate().map(move |(k, (code, own))| {
        hash = hash.wrapping_mul(FACTOR).wrapping_add(u64::from(*code));
        turned += usize::from(*own);
        if let Some((code, own)) = k.checked_sub(STEPS).map(|k| steps[k]) {
            hash = hash.wrapping_sub(oldest.wrapping_mul(u64::from(code)));
            turned -= usize::from(own);
        }
        (k + 1, hash, turned)
    });
    let often = hashes.filter(|(end, _, turned)| *end >= STEPS && *turned >= REVERSALS);
    often.map(|(end, hash, _)| (end - STEPS, hash))
}

/// The direction of each axis from every row to the next: up, down or none.
fn directions<'a>(
    rows: impl Iterator<Item = &'a Vector3<f64>> + Clone,
) -> impl Iterator<Item = [i8; 3]> {
    rows.clone().zip(rows.skip(1)).map(|(before, after)| {
        [0, 1, 2].map(|axis| {
            let (a, b) = (before[axis], after[axis]);
            i8::from(b > a) - i8::from(b < a)
        })
    })
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;

    #[test]
    fn a_part_of_a_recording_is_refused_beside_it_or_behind_it_and_another_session_is_not() {
        let of = |seed| Spec::hand_held(seed).run().unwrap().recording;
        let (whole, other) = (of(3), of(4));
        assert!(no_rows_come_again([&whole, &other]).is_ok());
        let half = |recording: &Recording| {
            let mut half = recording.clone();
            for stream in [&mut half.accelerometer, &mut half.gyroscope] {
                let stream = stream.as_mut().unwrap();
                let from = stream.t.len() / 2 + 17;
                stream.t.drain(..from);
                stream.values.drain(..from);
                // In another unit, as a table rounds it.
                for value in &mut stream.values {
                    *value = (*value / 9.80665).map(|v| (v * 1e7).round() / 1e7);
                }
            }
            half
        };
        assert!(no_rows_come_again([&whole, &half(&whole)]).is_err());
        assert!(no_rows_come_again([&half(&whole), &other, &whole]).is_err());
        let mut twice = whole;
        let stream = twice.accelerometer.as_mut().unwrap();
        stream.t.extend_from_within(..);
        stream.values.extend_from_within(..);
        assert!(no_rows_come_again([&twice]).is_err());
    }

    #[test]
    fn every_third_row_of_a_recording_is_refused_beside_it_and_of_another_session_is_not() {
        let of = |seed| Spec::hand_held(seed).run().unwrap().recording;
        let (whole, other) = (of(3), of(4));
        let mut thinned = whole.clone();
        for stream in [&mut thinned.accelerometer, &mut thinned.gyroscope] {
            let stream = stream.as_mut().unwrap();
            stream.t = stream.t.iter().copied().skip(1).step_by(3).collect();
            stream.values = stream.values.iter().copied().skip(1).step_by(3).collect();
        }
        assert!(no_rows_come_again([&whole, &thinned]).is_err());
        assert!(no_rows_come_again([&thinned, &other, &whole]).is_err());
        assert!(no_rows_come_again([&thinned, &other]).is_ok());
    }

    /// What a machine shakes is the same at any distance, and was not recorded twice.
    #[test]
    fn a_vibration_that_the_noise_does_not_hide_is_no_copy() {
        let mut recording = Spec::hand_held(5).run().unwrap().recording;
        let stream = recording.accelerometer.as_mut().unwrap();
        for (t, value) in stream.t.iter().zip(&mut stream.values) {
            let phase = std::f64::consts::TAU * 29.3 * t;
            *value += Vector3::new(0.0, 1.0, 2.0).map(|lag| 30.0 * (phase + lag).sin());
        }
        assert!(no_rows_come_again([&recording]).is_ok());
    }
}
