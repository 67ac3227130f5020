//! Check that a recording has the units that a calibration is for.

mod flipped;
mod reading_unit;
mod untold;

pub use reading_unit::TriadUnits;
pub use untold::{in_unit_of, read_in_unit_of};

use findings::{Finding, Kind};
use recording::{Error, Recording};
use sensor::Sensor;

use crate::calibration::Calibration;

/// Corrected specific force whose median norm lies within these multiples of gravity is in the
/// right unit: most of any recording is rest or gentle motion.
const PLAUSIBLE: std::ops::Range<f64> = 0.6..1.6;

/// Refuses a recording whose corrected specific force cannot be one: a calibration of raw counts on
/// readings in SI units, or the reverse, or of another device altogether; or whose axes have another sign.
///
/// # Errors
/// [`Error::Input`] with both norms, or with the axes that are flipped in one of them only.
pub fn check_units(calibration: &Calibration, recording: &Recording) -> Result<(), Error> {
    flipped::check(calibration, recording)?;
    let (Some(stream), Some(triad)) = (
        &recording.accelerometer,
        calibration.triad(Sensor::Accelerometer),
    ) else {
        return Ok(());
    };
    let base = triad.base();
    let mut norms: Vec<f64> = stream
        .values
        .iter()
        .map(|raw| base.correct(raw).norm())
        .collect();
    let middle = norms.len() / 2;
    if norms.is_empty() {
        return Ok(());
    }
    let median = *norms.select_nth_unstable_by(middle, f64::total_cmp).1;
    if PLAUSIBLE.contains(&(median / calibration.gravity)) {
        return Ok(());
    }
    Err(Error::input(
        Finding::of(Kind::OF_OTHER_UNITS)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Accelerometer)
            .number("median", median, "m/s^2")
            .number("gravity", calibration.gravity, "m/s^2"),
    ))
}
