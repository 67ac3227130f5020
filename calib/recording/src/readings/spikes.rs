//! Single readings far from their neighbours.

mod alone;
mod resolution;

use nalgebra::Vector3;
use sensor::Sensor;

use self::resolution::{MOST_MISSES, Spike, resolution, usual_reach};
use super::lone_sample::{self, AROUND, FEWEST_AROUND, Resolution, is_far};
use super::of_sensor::FIRST_ROW;
use super::symptom::Symptom;
use crate::averages::median;
use crate::recording::{Recording, Stream};

findings::tuning! {
    /// Fewer spikes than this may be knocks, and are left, unless one is far the largest or nothing else in the recording shares it.
    FEWEST: usize = 5;
    /// One is far the largest by so many times everything else.
    ALONE: f64 = 3.0;

    /// A reading that leaves its neighbours by so many times what nearly all readings of the sensor reach is a
    /// spike even where the device moves.
    HUGE: f64 = 5.0;

    /// Where as many were seen while the device was quiet, the usual one larger than this share of what nearly all readings reach, the
    /// transfer fails, and does so in turns as well ...
    OF_USUAL: f64 = 0.5;
    /// ... by at least this share of that reach. Fewer, or smaller ones, are shocks, as when a phone is laid down, and a single reading in a
    /// turn is one: up to 80 °/s, at rest up to 10 °/s.
    IN_MOTION: f64 = 0.25;

    /// Steps longer than this may hold a motion between two rests, s.
    SLOW: f64 = 0.04;

    /// More spikes than this share of the samples are no spikes.
    MOST: f64 = 0.02;
}

/// The recording with its spikes replaced by the mean of their neighbours, and what was found; `None` where
/// there are none.
pub fn without_spikes(recording: &Recording) -> Option<(Recording, Vec<Symptom>)> {
    let found = Sensor::ALL.map(|sensor| {
        let witness = witness(sensor).and_then(|other| recording.stream(other));
        found(sensor, recording.stream(sensor)?, witness)
    });
    if found.iter().all(Option::is_none) {
        return None;
    }
    let mut cleaned = recording.clone();
    let mut findings = Vec::new();
    for (sensor, finding) in Sensor::ALL.into_iter().zip(found) {
        if let (Some(stream), Some((finding, spikes))) = (cleaned.stream_mut(sensor), finding) {
            replace(&mut stream.values, &spikes);
            findings.push(finding);
        }
    }
    Some((cleaned, findings))
}

/// The sensor that feels a knock as well.
fn witness(sensor: Sensor) -> Option<Sensor> {
    match sensor {
        Sensor::Accelerometer => Some(Sensor::Gyroscope),
        Sensor::Gyroscope => Some(Sensor::Accelerometer),
        Sensor::Magnetometer => None,
    }
}

/// Puts the mean of the two neighbours on its axis in the place of each spike.
fn replace(values: &mut [Vector3<f64>], spikes: &[Spike]) {
    for &Spike { axis, at, .. } in spikes {
        if at > 0 && at + 1 < values.len() {
            values[at][axis] = 0.5 * (values[at - 1][axis] + values[at + 1][axis]);
        }
    }
}

/// The spikes of a stream, in words and each by itself.
fn found(
    sensor: Sensor,
    stream: &Stream,
    witness: Option<&Stream>,
) -> Option<(Symptom, Vec<Spike>)> {
    // A hand turns and shoves within one step of slow samples.
    if stream.median_step()? > SLOW.get() {
        return None;
    }
    let most = (MOST.get() * stream.len() as f64) as usize;
    let mut spikes = enough(sensor, &stream.values, most);
    spikes.extend(witness.map_or_else(Vec::new, |other| alone::alone(sensor, stream, other)));
    let rows = rows_of(&spikes);
    let times = rows.iter().map(|row| stream.t[row - FIRST_ROW]).collect();
    if rows.is_empty() || rows.len() > most.max(1) {
        return None;
    }
    let has = |axis: &usize| spikes.iter().any(|s| s.axis == *axis);
    let symptom = Symptom::Spikes {
        sensor,
        rows,
        times,
        axes: (0..3).filter(has).collect(),
        largest: largest(&spikes),
    };
    Some((symptom, spikes))
}

/// The spikes that stand out from what is around them, so many on each axis at `most`, where they are too many or too large for knocks.
fn enough(sensor: Sensor, values: &[Vector3<f64>], most: usize) -> Vec<Spike> {
    let reach = usual_reach(values);
    let mut spikes = of_axes(sensor, values, (most, reach), false);
    let usual = median(spikes.iter().map(|s| s.size)).unwrap_or(0.0);
    let transfer_fails = spikes.len() >= FEWEST.get() && usual > OF_USUAL.get() * reach;
    if sensor == Sensor::Gyroscope && transfer_fails {
        spikes = of_axes(sensor, values, (most, reach), true);
    }
    let rows = rows_of(&spikes);
    let is_certain = || largest(&spikes) > ALONE.get() * extent_without(values, &rows);
    let is_enough = rows.len() >= FEWEST.get() || is_certain();
    if is_enough && rows.len() <= most.max(1) {
        spikes
    } else {
        Vec::new()
    }
}

fn largest(spikes: &[Spike]) -> f64 {
    spikes.iter().map(|s| s.size).fold(0.0, f64::max)
}

/// The rows of some spikes, each once, in order.
fn rows_of(spikes: &[Spike]) -> Vec<usize> {
    let mut rows: Vec<usize> = spikes.iter().map(|s| s.at + FIRST_ROW).collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// The spikes of all axes, so many on each at `most`, of readings that nearly all lie within `reach`; `in_motion` too, where the device
/// moves.
fn of_axes(
    sensor: Sensor,
    values: &[Vector3<f64>],
    (most, reach): (usize, f64),
    in_motion: bool,
) -> Vec<Spike> {
    let of = |axis: usize| {
        of_axis(
            values,
            axis,
            &resolution(sensor, values, axis),
            (most, reach),
            in_motion,
        )
    };
    (0..3).flat_map(of).collect()
}

/// The same of one axis.
fn of_axis(
    values: &[Vector3<f64>],
    axis: usize,
    resolution: &Resolution,
    (most, reach): (usize, f64),
    in_motion: bool,
) -> Vec<Spike> {
    let size = |k: usize| lone_sample::size([k - 1, k, k + 1].map(|k| values[k][axis]));
    if values.len() < 2 * FEWEST_AROUND.get() {
        return Vec::new();
    }
    let mut sizes: Vec<(usize, f64)> = (1..values.len() - 1)
        .map(|k| (k, size(k)))
        .filter(|s| s.1 > 0.0)
        .collect();
    // Only the largest can be spikes: looking around each is what takes time.
    let place = sizes.len().min(most.max(1));
    if place < sizes.len() {
        sizes.select_nth_unstable_by(place, |a, b| b.1.total_cmp(&a.1));
        sizes.truncate(place);
    }
    sizes.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut spikes = Vec::new();
    let mut misses = 0;
    for (k, size) in sizes {
        let moves =
            || size > IN_MOTION.get() * reach && leaves_a_motion(values, axis, k, resolution);
        if size > HUGE.get() * reach
            || stands_out(values, axis, k, size, resolution)
            || in_motion && moves()
        {
            spikes.push(Spike { axis, at: k, size });
        } else {
            misses += 1;
        }
        if misses > MOST_MISSES.get() {
            break;
        }
    }
    spikes
}

/// Returns true if the samples around are quiet and the spike is far from them.
fn stands_out(
    values: &[Vector3<f64>],
    axis: usize,
    k: usize,
    size: f64,
    resolution: &Resolution,
) -> bool {
    let before = &values[k.saturating_sub(AROUND.get())..k.saturating_sub(1)];
    let after = &values[(k + 2).min(values.len())..(k + AROUND.get() + 1).min(values.len())];
    let around: Vec<f64> = before.iter().chain(after).map(|v| v[axis]).collect();
    lone_sample::stands_out(values[k][axis], size, &around, resolution)
}

/// Returns true if a reading is far from the mean of its neighbours, and those around it are not from that of theirs: a rate that
/// changes smoothly does not leave the line between its neighbours for one sample.
fn leaves_a_motion(
    values: &[Vector3<f64>],
    axis: usize,
    k: usize,
    resolution: &Resolution,
) -> bool {
    let off = |k: usize| {
        let of = |k: usize| values[k][axis];
        (of(k) - 0.5 * (of(k - 1) + of(k + 1))).abs()
    };
    let before = k.saturating_sub(AROUND.get()).max(1)..k.saturating_sub(1);
    let after = k + 2..(k + AROUND.get() + 1).min(values.len() - 1);
    let around: Vec<f64> = before.chain(after).map(off).collect();
    is_far(off(k), &around, resolution.step)
}

/// The largest size of a reading on any axis, but for those of the rows.
fn extent_without(values: &[Vector3<f64>], rows: &[usize]) -> f64 {
    let others = values.iter().enumerate();
    let others = others.filter(|(k, _)| rows.binary_search(&(k + FIRST_ROW)).is_err());
    others.map(|(_, v)| v.amax()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording() -> Recording {
        let t: Vec<f64> = (0..4000).map(|k| 0.01 * f64::from(k)).collect();
        let value = |k: usize| {
            let noise = |m: usize| ((k * k * m) % 997) as f64 / 500.0 - 1.0;
            let turn = if (1000..1500).contains(&k) { 0.05 } else { 0.0 };
            let wave = 2.0 * (turn * k as f64).sin();
            Vector3::new(
                0.02 * noise(3) + wave,
                0.02 * noise(7),
                9.8 + 0.02 * noise(11),
            )
        };
        let values = (0..4000).map(value).collect();
        Recording {
            accelerometer: Some(Stream { t, values }),
            ..Recording::default()
        }
    }

    #[test]
    fn a_single_full_scale_reading_is_replaced_on_its_axis_and_listed() {
        let mut spiked = recording();
        let values = &mut spiked.accelerometer.as_mut().unwrap().values;
        let mut clean = values[2000];
        clean.y = 0.5 * (values[1999].y + values[2001].y);
        values[2000].y = 156.9;
        let (cleaned, findings) = without_spikes(&spiked).unwrap();
        assert_eq!(cleaned.accelerometer.unwrap().values[2000], clean);
        let Symptom::Spikes { rows, axes, .. } = &findings[0] else {
            panic!("{findings:?}");
        };
        assert_eq!((rows.as_slice(), axes.as_slice()), (&[2002][..], &[1][..]));
        let said = findings[0].in_recording(&spiked);
        assert_eq!(said.word("listed"), Some("2002; t = 20.00 s"));
    }

    #[test]
    fn noise_that_leaves_a_dead_zone_is_no_spike_and_a_far_reading_is() {
        let mut still = recording();
        std::mem::swap(&mut still.accelerometer, &mut still.gyroscope);
        let values = &mut still.gyroscope.as_mut().unwrap().values;
        for (k, value) in values.iter_mut().enumerate() {
            value.z = 0.0;
            value.y = if k % 37 == 5 {
                0.02 + 1e-5 * (k % 97) as f64
            } else {
                0.0
            };
        }
        assert!(without_spikes(&still).is_none());
        for k in 0..10 {
            still.gyroscope.as_mut().unwrap().values[1700 + 200 * k].y = 1.5;
        }
        let (_, findings) = without_spikes(&still).unwrap();
        let Symptom::Spikes { rows, .. } = &findings[0] else {
            panic!("{findings:?}");
        };
        assert_eq!(rows.len(), 10);
    }

    #[test]
    fn a_transfer_that_fails_at_rest_fails_in_turns_too_and_a_shock_there_alone_is_none() {
        let mut turning = recording();
        std::mem::swap(&mut turning.accelerometer, &mut turning.gyroscope);
        let values = &mut turning.gyroscope.as_mut().unwrap().values;
        values.iter_mut().for_each(|v| v.z -= 9.8);
        values[1203].x += 2.0;
        assert!(without_spikes(&turning).is_none());
        let values = &mut turning.gyroscope.as_mut().unwrap().values;
        (0..5).for_each(|k| values[2500 + 150 * k].y += 2.5);
        let (_, findings) = without_spikes(&turning).unwrap();
        let Symptom::Spikes { rows, .. } = &findings[0] else {
            panic!("{findings:?}");
        };
        assert_eq!(rows, &[1205, 2502, 2652, 2802, 2952, 3102]);
    }

    #[test]
    fn ten_small_spikes_at_rest_are_found() {
        let mut spiked = recording();
        let values = &mut spiked.accelerometer.as_mut().unwrap().values;
        for k in 0..10 {
            values[1600 + 200 * k].z += 1.5;
        }
        let (_, findings) = without_spikes(&spiked).unwrap();
        let Symptom::Spikes { rows, .. } = &findings[0] else {
            panic!("{findings:?}");
        };
        assert_eq!(rows.len(), 10);
    }

    #[test]
    fn noise_turns_and_one_knock_are_no_spikes() {
        assert!(without_spikes(&recording()).is_none());
        let mut knocked = recording();
        knocked.accelerometer.as_mut().unwrap().values[2000].y += 1.5;
        assert!(without_spikes(&knocked).is_none());
    }
}
