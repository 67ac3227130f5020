//! Values that a slower sensor held while a faster one wrote rows.

use findings::{Finding, Findings, Kind};
use sensor::Sensor;

use crate::recording::Stream;

findings::tuning! {
    /// Rows in a run of equal values, on average, that make a slower clock.
    SLOWER: f64 = 1.4;
}

/// Returns the first index of each run of equal values, if the runs are those of a slower sensor.
pub(crate) fn held_runs(stream: &Stream) -> Option<Vec<usize>> {
    let changes = |&i: &usize| i == 0 || stream.values[i] != stream.values[i - 1];
    let mean = stream.len() as f64 / (0..stream.len()).filter(changes).count() as f64;
    if mean < SLOWER.get() {
        return None;
    }
    let starts: Vec<usize> = (0..stream.len()).filter(changes).collect();
    if starts.len() < 20 {
        return None;
    }
    let usual = [mean.floor() as usize, mean.ceil() as usize];
    let lengths = starts.windows(2).map(|w| w[1] - w[0]);
    let regular: Vec<usize> = lengths.filter(|length| usual.contains(length)).collect();
    // A sensor that stopped makes one long run, and the others are of one row each.
    let of_regular = regular.iter().sum::<usize>() as f64 / regular.len().max(1) as f64;
    let is_regular = regular.len() * 100 >= (starts.len() - 1) * 98;
    (is_regular && of_regular >= SLOWER.get()).then_some(starts)
}

/// The stream with the first of every run of equal values, if the runs are those of a slower clock:
/// at least 98 % of them of two neighbouring lengths, 1.4 rows or more on average. Equal values of a
/// coarsely quantised sensor at rest come in runs of every length and are left alone.
pub(crate) fn without_held(
    name: &str,
    sensor: Sensor,
    stream: Stream,
    warnings: &mut Findings,
) -> Stream {
    let Some(starts) = held_runs(&stream) else {
        return stream;
    };
    let mean = stream.len() as f64 / starts.len() as f64;
    warnings.push(
        Finding::of(Kind::SLOWER_SENSOR)
            .in_recording(name)
            .of_sensor(sensor)
            .number("ratio", mean, "1")
            .count("repetitions", stream.len() - starts.len()),
    );
    Stream {
        t: starts.iter().map(|&i| stream.t[i]).collect(),
        values: starts.iter().map(|&i| stream.values[i]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn stream(value: impl Fn(usize) -> f64) -> Stream {
        Stream {
            t: (0..2000).map(|k| 0.01 * k as f64).collect(),
            values: (0..2000)
                .map(|k| Vector3::new(value(k), 0.0, 9.8))
                .collect(),
        }
    }

    #[test]
    fn a_sensor_that_stopped_halfway_is_not_slow() {
        let stopped = stream(|k| if k < 1000 { k as f64 } else { 0.0 });
        assert_eq!(held_runs(&stopped), None);
    }

    #[test]
    fn values_of_a_sensor_of_half_the_rate_are_held() {
        let starts = held_runs(&stream(|k| (k / 2) as f64));
        assert_eq!(starts, Some((0..2000).step_by(2).collect()));
    }
}
