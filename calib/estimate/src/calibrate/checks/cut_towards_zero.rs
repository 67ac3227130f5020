//! An accelerometer whose readings are cut off towards zero instead of rounded.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::Recording;
use recording::intervals::Segmentation;
use recording::readings::least_step;
use sensor::Sensor;

use crate::methods::{AccelerometerRequest, fit_accelerometer, static_means};

/// Log-likelihood by which readings that are half a step larger have to explain the norms better: with nothing fitted, chance makes so
/// much in one of ten thousand recordings.
const BETTER: f64 = 9.2;

/// Fewest placements beyond the parameters.
const SPARE: usize = 4;

/// Says that readings are cut off towards zero, where readings that are half a step larger fit gravity far better: nothing is fitted,
/// so that chance does not make it.
pub fn cut_towards_zero<'a>(
    cut: impl Iterator<Item = (&'a Recording, &'a Segmentation)> + Clone,
    gravity: f64,
) -> Option<Finding> {
    let steps = |(recording, _): (&Recording, _)| {
        let stream = recording.accelerometer.as_ref()?;
        let step = |axis| least_step(&stream.values, axis);
        Some(Vector3::new(step(0)?, step(1)?, step(2)?))
    };
    let steps: Vec<Vector3<f64>> = cut.clone().map(steps).collect::<Option<_>>()?;
    let as_read = AccelerometerRequest {
        recordings: cut.clone().map(|(own, at)| static_means(own, at)).collect(),
        names: cut.clone().map(|(own, _)| own.name.clone()).collect(),
        model: accelerometer::model(),
        gravity,
    };
    let mut longer = as_read.clone();
    for ((means, step), (own, at)) in longer.recordings.iter_mut().zip(&steps).zip(cut.clone()) {
        for (mean, sign) in means.iter_mut().zip(signs(own, at)) {
            mean.raw += sign.component_mul(step) * 0.5;
        }
    }
    let left = |request: &AccelerometerRequest| {
        let fit = fit_accelerometer(request).ok()?;
        let residuals = &fit.first.residuals;
        let spare = residuals.len().saturating_sub(fit.fitted.free.len());
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        (spare >= SPARE).then_some((square, spare as f64, fit.unit.scale))
    };
    let ((as_read, spare, scale), (longer, ..)) = (left(&as_read)?, left(&longer)?);
    let (recording, _) = cut.clone().next()?;
    let step = steps.first()?.max() * scale;
    let better = 0.5 * spare * (as_read / longer).ln();
    (better > BETTER).then(|| {
        Finding::of(Kind::CutTowardsZero)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Accelerometer)
            .number("step", step, "m/s^2")
            .affects("corrected_reading", 0.5 * step, "m/s^2")
    })
}

/// The mean sign of the readings in every static interval of the accelerometer. What is cut to zero lies on either side of it: of an axis
/// that is level, some readings are longer, some shorter, and some are right.
fn signs(recording: &Recording, segmentation: &Segmentation) -> Vec<Vector3<f64>> {
    let Some(stream) = recording.accelerometer.as_ref() else {
        return Vec::new();
    };
    let statics = segmentation.statics.iter();
    let of_force = statics.filter(|rest| rest.accelerometer.is_some());
    of_force
        .map(|rest| {
            let own = &stream.values[stream.between(rest.span.from, rest.span.to)];
            let sign = |v: f64| if v == 0.0 { 0.0 } else { v.signum() };
            let sum: Vector3<f64> = own.iter().map(|v| v.map(sign)).sum();
            sum / own.len().max(1) as f64
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use recording::Stream;
    use recording::intervals::Span;

    use super::*;

    #[test]
    fn of_an_axis_that_is_level_only_the_readings_beside_zero_are_too_short() {
        let values = [
            [9.8, -0.01, 0.0],
            [9.8, -0.01, 0.0],
            [9.8, 0.0, 0.01],
            [9.8, -0.01, -0.01],
        ];
        let recording = Recording {
            accelerometer: Some(Stream {
                t: (0..4).map(f64::from).collect(),
                values: values.map(Vector3::from).to_vec(),
            }),
            ..Recording::default()
        };
        let span = Span { from: 0.0, to: 4.0 };
        let cut = Segmentation::from_spans(&recording, &[span], 1.0);
        assert_eq!(signs(&recording, &cut), [Vector3::new(1.0, -0.75, 0.0)]);
    }
}
