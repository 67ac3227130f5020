//! An accelerometer whose readings are cut off towards zero instead of rounded.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::Recording;
use recording::intervals::Segmentation;
use recording::readings::least_step;
use sensor::Sensor;

use crate::methods::{AccelerometerRequest, fit_accelerometer, static_means};
use crate::residuals::StaticMean;

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
    let steps = |recording: &Recording| {
        let stream = recording.accelerometer.as_ref()?;
        let step = |axis| least_step(&stream.values, axis);
        Some(Vector3::new(step(0)?, step(1)?, step(2)?))
    };
    let left = |share: f64| {
        let means = cut.clone().map(|(recording, segmentation)| {
            let step = steps(recording)? * share;
            let longer = |mean: StaticMean| StaticMean {
                raw: mean
                    .raw
                    .zip_map(&step, |raw, step| raw + step * raw.signum()),
                ..mean
            };
            let means = static_means(recording, segmentation).into_iter();
            Some(means.map(longer).collect())
        });
        let fit = fit_accelerometer(&AccelerometerRequest {
            recordings: means.collect::<Option<Vec<_>>>()?,
            names: cut.clone().map(|(r, _)| r.name.clone()).collect(),
            model: accelerometer::model(),
            gravity,
        });
        let fit = fit.ok()?;
        let residuals = &fit.first.residuals;
        let spare = residuals.len().saturating_sub(fit.fitted.free.len());
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        (spare >= SPARE).then_some((square, spare as f64, fit.unit.scale))
    };
    let ((as_read, spare, scale), (longer, ..)) = (left(0.0)?, left(0.5)?);
    let (recording, _) = cut.clone().next()?;
    let step = steps(recording)?.max() * scale;
    let better = 0.5 * spare * (as_read / longer).ln();
    (better > BETTER).then(|| {
        Finding::of(Kind::CutTowardsZero)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Accelerometer)
            .number("step", step, "m/s^2")
            .affects("corrected_reading", 0.5 * step, "m/s^2")
    })
}
