//! Placements that cannot show whether an accelerometer is linear.

use findings::{Finding, Kind};
use sensor::{Sensor, is_bias};

use crate::calibration::Calibration;

findings::tuning! {
    /// An error of a corrected reading by an effect of the usual size is said from here on, m/s²: nearly what such an effect makes where the
    /// placements do not show it at all (10.4e-3 of a cubic one at faces alone). Twelve placements with some edges leave up to 8.6e-3.
    WORTH: f64 = 9e-3;

    /// The standard errors count an error that is no larger than so many of them.
    COUNTED: f64 = 4.0;

    /// Half of such an effect is said where it is many standard errors: faces that are tilted a little, again and again, leave that.
    /// Placements all around leave up to 6e-3 m/s² as well where the noise is large, and are six standard errors off at most.
    HALF: f64 = 5.2e-3;
    /// So many standard errors are many.
    MANY: f64 = 12.0;
}

/// The parameter that is most off by an effect that the accelerometer may have and that these placements hardly show: with one face up
/// every time, a cubic error is a scale factor, whatever its size, and leaves no misfit. `None` where the calibration says
/// something of the kind already.
pub fn untested_linearity(calibration: &Calibration) -> Option<Finding> {
    if calibration.warnings.iter().any(says_it) {
        return None;
    }
    let triad = calibration.accelerometer.as_ref()?;
    let scale = triad.base().t.trace() / 3.0;
    let prefix = Sensor::Accelerometer.prefix();
    let worst_first = calibration.enlarged_by_more_than(COUNTED.get()).into_iter();
    worst_first
        .filter(|enlarged| enlarged.by.parameter.starts_with(prefix))
        .find_map(|enlarged| {
            let (own, times) = (enlarged.by, enlarged.ratio());
            let off = match is_bias(&own.parameter) {
                true => own.std_added * scale,
                false => own.std_added / scale * calibration.gravity,
            };
            let found = Finding::of(Kind::LINEARITY_UNTESTED)
                .of_sensor(Sensor::Accelerometer)
                .detail("effect", own.effect.clone())
                .detail("parameter", own.parameter.clone())
                .number("size", off, "m/s^2")
                .number("times", times, "1")
                .affects("corrected_reading", off, "m/s^2");
            (off > WORTH.get() || off > HALF.get() && times > MANY.get()).then_some(found)
        })
}

/// Returns true if a finding says that something is missing or cut off, or that the placements are too few to say: a misfit of the
/// accelerometer shows what they would hide, and one of the turns does not.
fn says_it(found: &Finding) -> bool {
    match found.kind {
        Kind::PLACEMENTS_MISSING | Kind::EFFECT_MISSING | Kind::CUT_TOWARDS_ZERO => true,
        Kind::MISFIT => found.place.sensor != Some(Sensor::Gyroscope),
        _ => false,
    }
}
