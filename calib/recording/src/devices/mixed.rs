//! Rows of several devices in a table that has no column to tell them apart.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::evidence::Rows;
use crate::Error;
use crate::averages::median;
use crate::recording::samples::Samples;
use crate::recording::stream::least_steps;
use crate::shown::figure;
use crate::source::place::at_line;

findings::tuning! {
    /// Most devices that are looked for in rows by turns.
    DEVICES: usize = 4;
    /// Rows looked at.
    LOOKED_AT: usize = 100_000;
    /// Parts of the rows, in each of which devices have to show.
    PARTS: usize = 4;
    /// Rows of each device in a row whose means are compared.
    IN_A_ROW: usize = 4;
    /// Places that are compared together.
    CHUNK: usize = 50;
    /// The mean over these places keeps more than this share of the squared difference between devices; of a beat it keeps less.
    KEPT: f64 = 0.4;
    /// Readings that far apart are those of different devices, in units of what those of one are apart.
    APART: f64 = 3.0;
}

/// Refuses samples in which rows of several devices stand by turns, or have one stamp.
///
/// # Errors
/// The first place, how far readings are apart, and what to do.
pub(crate) fn refuse(name: &str, sensor: Sensor, samples: &Samples) -> Result<(), Error> {
    if let Some(found) = twins(samples) {
        return Err(at_line(
            name,
            found.line,
            Finding::of(Kind::ROWS_OF_DEVICES)
                .of_sensor(sensor)
                .count("count", found.count)
                .detail("apart", rounded(found.apart))
                .detail("usual", rounded(found.usual)),
        ));
    }
    if let Some(devices) = in_turn(&samples.values) {
        return Err(at_line(
            name,
            samples.line(0),
            Finding::of(Kind::DEVICES_BY_TURNS)
                .of_sensor(sensor)
                .count("devices", devices),
        ));
    }
    Ok(())
}

/// A size in two digits.
fn rounded(value: f64) -> String {
    format!("{value:.1e}")
        .parse::<f64>()
        .map_or_else(|_| figure(value), figure)
}

/// Rows of one stamp.
struct Twins {
    line: u64,
    count: usize,
    apart: f64,
    usual: f64,
}

/// Rows with the stamp of another from which they are further than the next of one device would be.
fn twins(samples: &Samples) -> Option<Twins> {
    let apart: Vec<f64> = samples
        .other_twins()
        .map(|twin| (twin.value - samples.values[twin.of]).norm())
        .collect();
    let first = samples.other_twins().next()?;
    // The next stamp's first row is of the same device, and later than the twin.
    let next = |of: usize| {
        let neighbours = [of.checked_sub(1), Some(of + 1)];
        let value = |at: usize| samples.values.get(at).copied();
        let steps = neighbours.into_iter().flatten().filter_map(value);
        let steps = steps.map(|value| (value - samples.values[of]).norm());
        steps.fold(0.0, f64::max)
    };
    let usual = median(samples.other_twins().map(|twin| next(twin.of)))?;
    let in_all = median(
        samples
            .values
            .windows(2)
            .map(|w| (w[1] - w[0]).norm())
            .take(LOOKED_AT.get()),
    )?;
    let usual = usual.max(in_all).max(least_step(&samples.values));
    let middle = median(apart.iter().copied())?;
    // Of few pairs the noise alone makes some large.
    let factor = match apart.len() {
        0..5 => 3.0 * APART.get(),
        5..20 => 1.5 * APART.get(),
        _ => 0.67 * APART.get(),
    };
    (middle > factor * usual).then_some(Twins {
        line: first.line,
        count: apart.len(),
        apart: middle,
        usual,
    })
}

/// The smallest change of a reading; 0 where there is none.
fn least_step(values: &[Vector3<f64>]) -> f64 {
    let steps = least_steps(&values[..values.len().min(LOOKED_AT.get())]);
    let least = steps.into_iter().fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// Returns the number of devices that wrote rows in turn, if the readings show it from beginning to end.
pub fn in_turn(values: &[Vector3<f64>]) -> Option<usize> {
    // A device that is there all the time reads no zero on all axes; where reads fail, zeros stand by turns with readings.
    let read = values.iter().filter(|value| **value != Vector3::zeros());
    let values: &[Vector3<f64>] = &read.copied().take(LOOKED_AT.get()).collect::<Vec<_>>();
    let part = values.len() / PARTS.get();
    if part < 25 * DEVICES.get() {
        return None;
    }
    let step = least_step(values);
    let shows = |devices: usize| {
        values.chunks_exact(part).all(|values| {
            let labels: Vec<u8> = (0..values.len()).map(|i| (i % devices) as u8).collect();
            let rows = Rows {
                t: &[],
                values,
                labels: &labels,
            };
            rows.ratio() >= APART.get() && is_coarse(values, devices, step)
        })
    };
    let devices = (2..=DEVICES.get()).find(|devices| shows(*devices))?;
    (!is_vibration(values, devices)).then_some(devices)
}

/// True where what is between rows by turns points another way all the time: a vibration near a half, a third or a fourth of the rate beats
/// with it. Between devices it is the same while they rest.
fn is_vibration(values: &[Vector3<f64>], devices: usize) -> bool {
    let rows = IN_A_ROW.get() * devices;
    let between = |rows: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
        let whole = rows.iter().sum::<Vector3<f64>>() / rows.len() as f64;
        let of = |device: usize| {
            let own = rows.iter().skip(device).step_by(devices);
            own.sum::<Vector3<f64>>() / IN_A_ROW.get() as f64 - whole
        };
        (0..devices).map(of).collect()
    };
    let turns = |rows: &[Vector3<f64>]| {
        let mut sums = vec![Vector3::zeros(); devices];
        let mut squares = 0.0;
        let count = rows.len() / (IN_A_ROW.get() * devices);
        for part in rows.chunks_exact(IN_A_ROW.get() * devices) {
            for (sum, own) in sums.iter_mut().zip(between(part)) {
                *sum += own;
                squares += own.norm_squared();
            }
        }
        let kept = sums.iter().map(|sum| sum.norm_squared()).sum::<f64>() / count as f64;
        kept < KEPT.get() * squares
    };
    let chunks: Vec<bool> = values.chunks_exact(rows * CHUNK.get()).map(turns).collect();
    2 * chunks.iter().filter(|turns| **turns).count() > chunks.len()
}

/// True where rows that follow one another differ by more than steps of a coarse sensor.
fn is_coarse(values: &[Vector3<f64>], devices: usize, step: f64) -> bool {
    let turns = values.windows(2).step_by(devices);
    let apart = median(turns.map(|w| (w[1] - w[0]).amax()));
    apart.is_some_and(|apart| apart > 4.0 * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings about `mean` with noise of 1.
    fn noisy(k: usize, mean: f64) -> Vector3<f64> {
        let noise = |n: usize| (((k * 7919 + n * 104_729) % 1009) as f64 / 1009.0 - 0.5) * 3.46;
        Vector3::new(mean + noise(1), noise(2), 9.0 + noise(3))
    }

    #[test]
    fn devices_that_write_by_turns_are_counted() {
        for devices in 2..=4 {
            let mean = |k: usize| 20.0 * ((k % devices) * (k % devices)) as f64;
            let rows: Vec<_> = (0..2000).map(|k| noisy(k, mean(k))).collect();
            assert_eq!(in_turn(&rows), Some(devices));
        }
        let one: Vec<_> = (0..2000).map(|k| noisy(k, 0.0)).collect();
        assert_eq!(in_turn(&one), None);
        // A coarse sensor that flickers between two counts.
        let coarse: Vec<_> = (0..2000)
            .map(|k| Vector3::new((k % 2) as f64, 0.0, 9.0))
            .collect();
        assert_eq!(in_turn(&coarse), None);
        // One on a machine that hums at 49.7 Hz, sampled at 100 Hz.
        let hum = |k: usize| 10.0 * (std::f64::consts::TAU * 0.497 * k as f64).sin();
        let humming: Vec<_> = (0..4000).map(|k| noisy(k, hum(k))).collect();
        assert_eq!(in_turn(&humming), None);
        // One of which every other read fails.
        let read = |k: usize| {
            if k.is_multiple_of(2) {
                Vector3::zeros()
            } else {
                noisy(k, 0.0)
            }
        };
        let failing: Vec<_> = (0..4000).map(read).collect();
        assert_eq!(in_turn(&failing), None);
        // One that moves.
        let turning: Vec<_> = (0..2000)
            .map(|k| noisy(k, (0.02 * k as f64).sin() * 300.0))
            .collect();
        assert_eq!(in_turn(&turning), None);
    }

    #[test]
    fn equal_stamps_of_two_devices_are_told_from_those_of_a_coarse_clock() {
        let samples = |offset: f64| {
            let mut samples = Samples::default();
            for k in 0..200 {
                let mean = if k % 2 == 0 { 0.0 } else { offset };
                samples.push((k / 2) as f64, noisy(k, mean), k as u64 + 1);
            }
            samples
        };
        assert!(twins(&samples(0.0)).is_none());
        assert!(twins(&samples(20.0)).is_some());
    }
}
