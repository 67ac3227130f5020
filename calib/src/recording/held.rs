//! Values that a slower sensor held while a faster one wrote rows.

use sensor::Sensor;

use super::Stream;

/// The stream with the first of every run of equal values, if the runs are those of a slower clock:
/// at least 98 % of them of two neighbouring lengths, 1.4 rows or more on average. Equal values of a
/// coarsely quantised sensor at rest come in runs of every length and are left alone.
pub(super) fn without_held(
    name: &str,
    sensor: Sensor,
    stream: Stream,
    warnings: &mut Vec<String>,
) -> Stream {
    let changes = |&i: &usize| i == 0 || stream.values[i] != stream.values[i - 1];
    let mean = stream.len() as f64 / (0..stream.len()).filter(changes).count() as f64;
    if mean < 1.4 {
        return stream;
    }
    let starts: Vec<usize> = (0..stream.len()).filter(changes).collect();
    if starts.len() < 20 {
        return stream;
    }
    let usual = [mean.floor() as usize, mean.ceil() as usize];
    let regular = starts
        .windows(2)
        .filter(|w| usual.contains(&(w[1] - w[0])))
        .count();
    if regular * 100 < (starts.len() - 1) * 98 {
        return stream;
    }
    warnings.push(format!(
        "{name}: the {} is {mean:.2} times slower than the rows and its values are held; {} repetitions left out",
        sensor.name(),
        stream.len() - starts.len()
    ));
    Stream {
        t: starts.iter().map(|&i| stream.t[i]).collect(),
        values: starts.iter().map(|&i| stream.values[i]).collect(),
    }
}
