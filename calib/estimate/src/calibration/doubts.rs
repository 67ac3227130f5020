//! Check that a recording is of the device and in the units that a calibration is for.

use findings::{Finding, Kind, Level, OptionName, Remedy};
use nalgebra::Vector3;
use recording::averages::root_mean_square;
use recording::intervals::{Detector, Segmentation};
use recording::{Error, Recording};
use sensor::Sensor;

use super::Calibration;
use crate::evaluate::{FieldMisfit, Misfits, misfits, unspoilt};
use crate::methods::cut;

findings::tuning! {
    /// A corrected rate above this in static intervals is none of the device or unit that was calibrated, rad/s. Biases of
    /// cheap gyroscopes come back to a tenth of it.
    FOREIGN_RATE: f64 = 0.3;

    /// Above this the bias has moved by more than a turn of a minute leaves unseen (0.3 °/s), rad/s.
    MOVED_RATE: f64 = 0.005;

    /// Gravity missed by more than this through turns: another unit, sign or order of axes, °.
    FOREIGN_ANGLE: f64 = 20.0;

    /// Turns that show so.
    ENOUGH_TURNS: usize = 3;

    /// Static intervals that show an uneven field.
    ENOUGH_FIELDS: usize = 4;

    /// Spread of a corrected field's strength, or of its angle to the vertical in rad, from one static interval to the next that is no field
    /// of a room away from iron (2.3°).
    UNEVEN: f64 = 0.04;

    /// Longer turns add up too much of a bias to judge by, s.
    LONGEST_TURN: f64 = 20.0;

    /// Ratio of the residual to that of the calibration's own recordings above which it is doubted.
    WORSE: f64 = 5.0;

    /// A misfit of gravity's norm that has grown by [`WORSE`] is stated from here on, m/s² (1 mg).
    GROWN: f64 = 0.01;
}

/// No doubt below these, ° and m/s²: what other hands, places and temperatures make.
const FINE: (f64, f64) = (0.5, 0.05);

/// Compares a recording with a calibration at its static intervals and through its turns; of a recording without these,
/// and with effects that cannot be known, nothing is said.
///
/// # Errors
/// [`Error::Input`] where rate or direction are such that the calibration is of another device, unit, sign or order of
/// axes.
pub fn doubts(calibration: &Calibration, recording: &Recording) -> Result<Vec<Finding>, Error> {
    let mut said = Vec::new();
    said.extend(calibration.doubts_corrections_of(recording));
    let found = cut(recording, &Detector::default(), true, calibration.gravity);
    let Ok(choice) = found else { return Ok(said) };
    let segmentation = &choice.segmentation;
    let Ok(left) = misfits(
        recording,
        segmentation,
        Some(calibration),
        calibration.gravity,
    ) else {
        return Ok(said);
    };
    said.extend(rate_in_doubt(recording, calibration, &left)?);
    said.extend(direction_in_doubt(
        recording,
        calibration,
        segmentation,
        &left,
    )?);
    said.extend(norm_in_doubt(recording, calibration, &left));
    said.extend(field_in_doubt(recording, calibration, &left));
    Ok(said)
}

/// A doubt that is none any more: only who knows that the device is the same goes on.
fn beyond_doubt(doubt: Finding) -> Error {
    let force = Remedy::set(OptionName::ForceDevice);
    Error::input(doubt.at_level(Level::Error).only_remedies([force]))
}

fn rate_in_doubt(
    recording: &Recording,
    calibration: &Calibration,
    left: &Misfits,
) -> Result<Option<Finding>, Error> {
    if calibration.gyroscope.is_none() || left.rates.is_empty() {
        return Ok(None);
    }
    let mean = left.rates.iter().sum::<Vector3<f64>>() / left.rates.len() as f64;
    let size = mean.norm();
    let doubt = || {
        Finding::of(Kind::RATE_AT_REST_OFF)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Gyroscope)
            .number("size", size, "rad/s")
            .detail(
                "rate",
                format!("{:.4}, {:.4}, {:.4} rad/s", mean.x, mean.y, mean.z),
            )
            .affects("corrected_reading", size, "rad/s")
    };
    if size > FOREIGN_RATE.get() {
        return Err(beyond_doubt(doubt()));
    }
    Ok((size > MOVED_RATE.get()).then(doubt))
}

fn direction_in_doubt(
    recording: &Recording,
    calibration: &Calibration,
    segmentation: &Segmentation,
    left: &Misfits,
) -> Result<Option<Finding>, Error> {
    let Some(triad) = &calibration.gyroscope else {
        return Ok(None);
    };
    let short = left.turns.iter().filter(|turn| {
        let own = segmentation.turns.iter().find(|t| t.from == turn.index);
        own.is_some_and(|t| t.span.length() < LONGEST_TURN.get())
    });
    let short: Vec<f64> = short.map(|turn| turn.value).collect();
    // A turn that lost rows is none of the device.
    let sound = unspoilt(&short, |angle| *angle).into_iter();
    let angles: Vec<f64> = sound.map(|k| short[k]).collect();
    if angles.len() < ENOUGH_TURNS.get() || calibration.accelerometer.is_none() {
        return Ok(None);
    }
    let rms = root_mean_square(&angles);
    let usual = triad.residual_rms;
    let doubt = || {
        let found = Finding::of(Kind::DIRECTION_OFF)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Gyroscope)
            .count("count", angles.len())
            .number("rms", rms.to_radians(), "rad")
            .affects("turn", rms.to_radians(), "rad");
        left_of_its_own(found, usual.to_radians(), "rad")
    };
    // A calibration that misses its own recordings as much is bad, not foreign: its gate has said so.
    if rms > FOREIGN_ANGLE.get().max(WORSE.get() * usual) {
        return Err(beyond_doubt(doubt()));
    }
    Ok((rms > (WORSE.get() * usual).max(FINE.0)).then(doubt))
}

fn norm_in_doubt(
    recording: &Recording,
    calibration: &Calibration,
    left: &Misfits,
) -> Option<Finding> {
    let usual = calibration.accelerometer.as_ref()?.residual_rms;
    let values: Vec<f64> = left.rests.iter().map(|rest| rest.value).collect();
    let rms = root_mean_square(&values);
    // What another tool made does not say what it left.
    let kind = match (WORSE.get() * usual, usual > 0.0) {
        (worse, _) if rms > worse.max(FINE.1) => Kind::NORM_OFF,
        (worse, true) if rms > worse.max(GROWN.get()) => Kind::NORM_GROWN,
        _ => return None,
    };
    let found = Finding::of(kind)
        .in_recording(&recording.name)
        .of_sensor(Sensor::Accelerometer)
        .number("rms", rms, "m/s^2")
        .affects("corrected_reading", rms, "m/s^2");
    Some(left_of_its_own(found, usual, "m/s^2"))
}

fn field_in_doubt(
    recording: &Recording,
    calibration: &Calibration,
    left: &Misfits,
) -> Option<Finding> {
    let own = calibration.magnetic_field.as_ref()?;
    let seen =
        FieldMisfit::of(&left.fields).filter(|_| left.fields.len() >= ENOUGH_FIELDS.get())?;
    let usual = own.unevenness / own.last.strength;
    let angle = seen.angle_spread.to_radians();
    let limit = UNEVEN.get().max(WORSE.get() * usual);
    (seen.norm_spread.max(angle) > limit).then(|| {
        let found = Finding::of(Kind::FIELD_OFF)
            .in_recording(&recording.name)
            .of_sensor(Sensor::Magnetometer)
            .number("share", seen.norm_spread, "share")
            .number("angle", angle, "rad")
            .affects("heading", angle, "rad");
        left_of_its_own(found, usual, "share")
    })
}

/// With what a calibration left of its own recordings; nothing of one that another tool made, which does not say.
fn left_of_its_own(found: Finding, usual: f64, unit: &'static str) -> Finding {
    match usual > 0.0 {
        true => found.number("usual", usual, unit),
        false => found,
    }
}
