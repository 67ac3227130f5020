//! Values that a slower sensor held while a faster one wrote rows.

use sensor::Sensor;

use crate::recording::Stream;

/// Where runs of equal values begin, if they are those of a slower clock.
pub(crate) fn held_runs(stream: &Stream) -> Option<Vec<usize>> {
    let changes = |&i: &usize| i == 0 || stream.values[i] != stream.values[i - 1];
    let mean = stream.len() as f64 / (0..stream.len()).filter(changes).count() as f64;
    if mean < 1.4 {
        return None;
    }
    let starts: Vec<usize> = (0..stream.len()).filter(changes).collect();
    if starts.len() < 20 {
        return None;
    }
    let usual = [mean.floor() as usize, mean.ceil() as usize];
    let pairs = starts.windows(2);
    let regular = pairs.filter(|w| usual.contains(&(w[1] - w[0]))).count();
    (regular * 100 >= (starts.len() - 1) * 98).then_some(starts)
}

/// The stream with the first of every run of equal values, if the runs are those of a slower clock:
/// at least 98 % of them of two neighbouring lengths, 1.4 rows or more on average. Equal values of a
/// coarsely quantised sensor at rest come in runs of every length and are left alone.
pub(crate) fn without_held(
    name: &str,
    sensor: Sensor,
    stream: Stream,
    warnings: &mut Vec<String>,
) -> Stream {
    let Some(starts) = held_runs(&stream) else {
        return stream;
    };
    let mean = stream.len() as f64 / starts.len() as f64;
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
