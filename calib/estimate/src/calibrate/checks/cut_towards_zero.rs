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

/// Says that readings are cut off towards zero, where static means that are half a step larger fit gravity far better: nothing is fitted,
/// so that chance does not make it.
pub(in crate::calibrate) fn cut_towards_zero<'a>(
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
    for (means, step) in longer.recordings.iter_mut().zip(&steps) {
        for mean in means {
            let half = mean
                .raw
                .zip_map(step, |raw, step| 0.5 * step * raw.signum());
            mean.raw += half;
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
