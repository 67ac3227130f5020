//! When the device was still, as a picture.

use calib::Recording;
use calib::intervals::{Segmentation, StaticInterval};
use calib::recording::Stream;
use nalgebra::Vector3;

use crate::report::{Axis, Plot, Series};
use crate::show;

/// Colour of the samples behind the static intervals.
const GREY: usize = 6;

/// Stretches in which the range of the samples is drawn.
const STRETCHES: usize = 200;

/// The norm of the accelerometer's readings over time (of the gyroscope's, without one), static intervals
/// marked with their `keys`; `units` of accelerometer and gyroscope.
pub fn intervals_plot(
    recording: &Recording,
    segmentation: &Segmentation,
    units: [&str; 2],
    keys: Vec<String>,
) -> Plot {
    type Mean = fn(&StaticInterval) -> Option<f64>;
    let force: Mean = |rest| Some(rest.accelerometer?.mean.norm());
    let rate: Mean = |rest| Some(rest.gyroscope?.mean.norm());
    let (unit, stream, mean) = match (&recording.accelerometer, &recording.gyroscope) {
        (Some(stream), _) => (units[0], Some(stream), force),
        (None, stream) => (units[1], stream.as_ref(), rate),
    };
    let stretches = segmentation
        .statics
        .iter()
        .filter_map(|rest| Some((rest.span.from, rest.span.to, mean(rest)?)))
        .collect();
    Plot::new(
        format!("Static intervals of {}", show::name(&recording.name)),
        Axis::linear("time, s"),
        Axis::linear(format!("norm of the readings, {unit}")),
    )
    .with(Series::ranges(
        "readings",
        GREY,
        stream.map_or_else(Vec::new, ranges),
    ))
    .with(Series::stretches("static intervals", 0, stretches).of(keys))
}

/// Smallest and largest norm in each of a few hundred stretches `(t, low, high)`: a line through
/// every k-th sample would miss short motions.
fn ranges(stream: &Stream) -> Vec<(f64, f64, f64)> {
    let length = stream.len().div_ceil(STRETCHES).max(1);
    let range = |(t, values): (&[f64], &[Vector3<f64>])| {
        let norms = values.iter().map(Vector3::norm);
        let (low, high) = norms.fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
        (0.5 * (t[0] + t[t.len() - 1]), low, high)
    };
    stream
        .t
        .chunks(length)
        .zip(stream.values.chunks(length))
        .map(range)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_loud_sample_of_many_is_in_the_range_of_its_stretch() {
        let mut stream = Stream {
            t: (0..30_000).map(f64::from).collect(),
            values: vec![Vector3::z(); 30_000],
        };
        stream.values[12_345] = Vector3::z() * 7.0;
        let found = ranges(&stream);
        assert_eq!(found.len(), STRETCHES);
        let loud: Vec<_> = found.iter().filter(|(_, _, high)| *high == 7.0).collect();
        // Sample 12,345 lies in the 83rd stretch of 150: 12,300 to 12,449.
        assert_eq!(loud, [&(12_374.5, 1.0, 7.0)]);
        assert_eq!(ranges(&Stream::default()), []);
    }
}
