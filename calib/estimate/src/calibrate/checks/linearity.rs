//! Placements that cannot show whether an accelerometer is linear.

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::calibration::Calibration;

/// An error of a corrected reading by an effect of the usual size is said from here on, m/s²: nearly what such an effect makes where the
/// placements do not show it at all (10.4e-3 of a cubic one at faces alone). Twelve placements with some edges leave up to 8.6e-3.
const WORTH: f64 = 9e-3;

/// The standard errors count an error that is no larger than so many of them.
const COUNTED: f64 = 4.0;

/// The parameter that is most off by an effect that the accelerometer may have and that these placements hardly show: with one face up
/// every time, a cubic error is a scale factor, whatever its size, and leaves no misfit.
pub(in crate::calibrate) fn untested_linearity(calibration: &Calibration) -> Option<Finding> {
    let triad = calibration.accelerometer.as_ref()?;
    let scale = triad.base().t.trace() / 3.0;
    let prefix = Sensor::Accelerometer.prefix();
    let worst_first = calibration.enlarged_by_more_than(COUNTED).into_iter();
    worst_first
        .filter(|enlarged| enlarged.by.parameter.starts_with(prefix))
        .find_map(|enlarged| {
            let own = enlarged.by;
            let off = match own.parameter.contains(".b_") {
                true => own.std_added * scale,
                false => own.std_added / scale * calibration.gravity,
            };
            let found = Finding::of(Kind::LinearityUntested)
                .of_sensor(Sensor::Accelerometer)
                .detail("effect", own.effect.clone())
                .detail("parameter", own.parameter.clone())
                .number("size", off, "m/s^2")
                .number("times", enlarged.ratio(), "1")
                .affects("corrected_reading", off, "m/s^2");
            (off > WORTH).then_some(found)
        })
}
