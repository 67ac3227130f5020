//! The noise within the static intervals: Allan deviation, averaged over intervals.

use calib::intervals::Segmentation;
use calib::recording::Stream;
use nalgebra::Vector3;

use super::session::Session;
use crate::report::{Axis, Picture, Plot, Series};

const GREY: usize = 6;
/// Differences that a point needs.
const ENOUGH: usize = 8;
/// Samples of all intervals that are looked at: more make the curve no clearer.
const SAMPLES: usize = 400_000;

/// Curves of one sensor: `(τ, deviation)` for each axis.
type Curves = [Vec<(f64, f64)>; 3];

/// The pictures, one for each sensor that there is; `units` of accelerometer and gyroscope.
pub fn pictures(session: &Session<'_>, units: [&str; 2]) -> Vec<Picture> {
    let mut all = Vec::new();
    type Of = fn(&calib::Recording) -> Option<&Stream>;
    let sensors: [(&str, &str, Of); 2] = [
        ("accelerometer", units[0], |r| r.accelerometer.as_ref()),
        ("gyroscope", units[1], |r| r.gyroscope.as_ref()),
    ];
    for (name, unit, of) in sensors {
        let parts = session.parts.iter();
        let streams = parts.filter_map(|p| Some((of(p.recording)?, p.segmentation)));
        let streams: Vec<_> = streams.collect();
        let curves = curves(&streams);
        if curves.iter().all(|curve| curve.len() < 2) {
            continue;
        }
        let plot = Plot::new(
            format!("Noise of the {name} within static intervals"),
            Axis::log("averaging time τ, s"),
            Axis::log(format!("Allan deviation, {unit}")),
        );
        let first = curves
            .iter()
            .filter_map(|curve| curve.first())
            .next()
            .copied();
        let last = curves.iter().flatten().map(|p| p.0).fold(0.0, f64::max);
        let plot = match first {
            Some((tau, deviation)) => plot.with(Series::dashed(
                "white noise",
                GREY,
                vec![(tau, deviation), (last, deviation * (tau / last).sqrt())],
            )),
            None => plot,
        };
        let axes = ["x", "y", "z"].into_iter().zip([0, 1, 3]).zip(curves);
        let plot = axes.fold(plot, |plot, ((name, colour), curve)| {
            plot.with(Series::line(name, colour, curve))
        });
        all.push(plot.into());
    }
    all
}

/// Allan deviation over blocks of 1, 2, 4, … samples, differences taken within static intervals only.
fn curves(streams: &[(&Stream, &Segmentation)]) -> Curves {
    let mut curves: Curves = Default::default();
    let Some(step) = streams.first().and_then(|(s, _)| s.median_step()) else {
        return curves;
    };
    let mut left = SAMPLES;
    let mut runs: Vec<&[Vector3<f64>]> = Vec::new();
    for (stream, segmentation) in streams {
        for rest in &segmentation.statics {
            let from = stream.t.partition_point(|t| *t < rest.span.from);
            let to = stream.t.partition_point(|t| *t <= rest.span.to);
            let to = to.min(from + left);
            left -= to - from;
            runs.push(&stream.values[from..to]);
        }
    }
    let mut blocks = 1;
    loop {
        let (mut sum, mut count) = (Vector3::zeros(), 0);
        for run in &runs {
            let means = run
                .chunks_exact(blocks)
                .map(|b| b.iter().sum::<Vector3<f64>>() / blocks as f64);
            let means: Vec<_> = means.collect();
            for pair in means.windows(2) {
                let d = pair[1] - pair[0];
                sum += d.component_mul(&d);
                count += 1;
            }
        }
        if count < ENOUGH {
            return curves;
        }
        for (axis, curve) in curves.iter_mut().enumerate() {
            let deviation = (0.5 * sum[axis] / count as f64).sqrt();
            if deviation > 0.0 {
                curve.push((blocks as f64 * step, deviation));
            }
        }
        blocks *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use calib::Recording;
    use calib::intervals::Span;

    #[test]
    fn white_noise_falls_with_the_root_of_the_averaging_time() {
        // White noise by the generator of NIST SP 1065, section 12.4: deviation of one uniform sample 1/√12.
        let mut state = 1_234_567_890_u64;
        let mut noise = || {
            state = 16_807 * state % 2_147_483_647;
            state as f64 / 2_147_483_647.0 - 0.5
        };
        let values: Vec<_> = (0..20_000)
            .map(|_| Vector3::new(noise(), noise(), noise()))
            .collect();
        let t = (0..20_000).map(|k| f64::from(k) * 0.01).collect();
        let stream = Stream { t, values };
        let spans = [
            Span {
                from: 0.0,
                to: 99.0,
            },
            Span {
                from: 100.0,
                to: 200.0,
            },
        ];
        let recording = Recording {
            accelerometer: Some(stream.clone()),
            ..Recording::default()
        };
        let cut = Segmentation::from_spans(&recording, &spans, 1.0);
        let curves = curves(&[(&stream, &cut)]);
        for (k, (tau, deviation)) in curves[0].iter().take(6).enumerate() {
            let samples = 2f64.powi(k as i32);
            assert!((tau - 0.01 * samples).abs() < 1e-12);
            let due = (1.0 / 12.0 / samples).sqrt();
            // 20,000 samples in blocks of 32 leave 600 differences: 4 % of one standard deviation.
            assert!(
                (deviation / due - 1.0).abs() < 0.12,
                "{tau}: {deviation} {due}"
            );
        }
    }
}
