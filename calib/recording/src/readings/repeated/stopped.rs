//! A sensor that stops to read while the other goes on.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::Error;
use crate::recording::{Recording, Stream};
use crate::shown::significant;
use crate::source::place::in_file;

findings::tuning! {
    /// Samples of one reading at the end that make a sensor stopped ...
    STOPPED: usize = 100;
    /// ... where it read the same on all axes in no more than so many samples in a row before: a noisy sensor, finer than its
    /// noise.
    USUAL: usize = 10;
}

/// Refuses a recording of which one sensor repeats its last reading to the end, on all axes, while the other changes.
///
/// # Errors
/// [`Error::Input`] with the sensor and the time from which on it does.
pub(crate) fn refuse_stopped(recording: &Recording) -> Result<(), Error> {
    let (Some(force), Some(rate)) = (&recording.accelerometer, &recording.gyroscope) else {
        return Ok(());
    };
    for (sensor, stream, other) in [
        (Sensor::Accelerometer, force, rate),
        (Sensor::Gyroscope, rate, force),
    ] {
        let Some(count) = stopped(&stream.values) else {
            continue;
        };
        let from = stream.t[stream.len() - count];
        if !changes_after(other, from) {
            continue;
        }
        let found = Finding::of(Kind::SENSOR_STOPPED)
            .of_sensor(sensor)
            .from_time(from)
            .count("count", count)
            .detail("reading", in_words(&stream.values[stream.len() - 1]));
        return Err(in_file(&recording.name, found));
    }
    Ok(())
}

/// One number where all axes have it.
fn in_words(reading: &Vector3<f64>) -> String {
    let axes: Vec<String> = reading.iter().map(|v| significant(*v, 3)).collect();
    match axes.iter().all(|axis| *axis == axes[0]) {
        true => axes[0].clone(),
        false => axes.join(", "),
    }
}

/// Returns the number of samples at the end that are the same on all axes, if chance does not explain it.
fn stopped(values: &[Vector3<f64>]) -> Option<usize> {
    let mut runs = values.chunk_by(|a, b| a == b).map(<[_]>::len).rev();
    let last = runs.next().filter(|&run| run >= STOPPED.get())?;
    runs.all(|run| run <= USUAL.get()).then_some(last)
}

fn changes_after(stream: &Stream, from: f64) -> bool {
    let after = &stream.values[stream.between(from, f64::INFINITY)];
    after.windows(2).filter(|pair| pair[0] != pair[1]).count() >= STOPPED.get()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noisy(count: usize) -> Vec<Vector3<f64>> {
        let noise = |k: usize| ((k * k * 7) % 997) as f64;
        (0..count)
            .map(|k| Vector3::new(noise(k), noise(k + 3), noise(k + 5)))
            .collect()
    }

    #[test]
    fn a_noisy_sensor_that_repeats_one_reading_to_the_end_has_stopped() {
        let mut values = noisy(1000);
        values[700..].fill(Vector3::zeros());
        assert_eq!(stopped(&values), Some(300));
    }

    #[test]
    fn coarse_readings_of_a_device_at_rest_have_not() {
        let mut values = noisy(1000);
        values[200..350].fill(Vector3::new(0.0, 0.0, 9.8));
        values[700..].fill(Vector3::new(0.0, 0.0, 9.8));
        assert_eq!(stopped(&values), None);
        assert_eq!(stopped(&noisy(1000)), None);
    }
}
