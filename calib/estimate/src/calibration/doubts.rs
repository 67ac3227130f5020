//! Whether a recording looks like one of the device and the units that a calibration is for.

use nalgebra::Vector3;
use recording::averages::root_mean_square;
use recording::intervals::{Detector, Segmentation};
use recording::{Error, Recording};

use super::Calibration;
use crate::evaluate::{Misfits, misfits};
use crate::methods::cut;

/// A corrected rate above this in static intervals is none of the device or unit that was calibrated, rad/s. Biases of
/// cheap gyroscopes come back to a tenth of it.
const FOREIGN_RATE: f64 = 0.3;

/// Above this the bias has moved more than biases do from one day to the next (1 °/s), rad/s.
const MOVED_RATE: f64 = 0.0175;

/// Gravity missed by more than this through turns: another unit, sign or order of axes, °.
const FOREIGN_ANGLE: f64 = 20.0;

/// Turns that show so.
const ENOUGH_TURNS: usize = 3;

/// Longer turns add up too much of a bias to judge by, s.
const LONGEST_TURN: f64 = 20.0;

/// What is left is doubted from so many times what the calibration left of its own recordings.
const WORSE: f64 = 5.0;

/// No doubt below these, ° and m/s²: what other hands, places and temperatures make.
const FINE: (f64, f64) = (1.0, 0.1);

/// Compares a recording with a calibration at its static intervals and through its turns; of a recording without these,
/// and with effects that cannot be known, nothing is said.
///
/// # Errors
/// [`Error::Input`] where rate or direction are such that the calibration is of another device, unit, sign or order of
/// axes.
pub fn doubts(calibration: &Calibration, recording: &Recording) -> Result<Vec<String>, Error> {
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
    let name = &recording.name;
    said.extend(rate_in_doubt(name, calibration, &left)?);
    said.extend(direction_in_doubt(name, calibration, segmentation, &left)?);
    said.extend(norm_in_doubt(name, calibration, &left));
    Ok(said)
}

fn rate_in_doubt(
    name: &str,
    calibration: &Calibration,
    left: &Misfits,
) -> Result<Option<String>, Error> {
    if calibration.gyroscope.is_none() || left.rates.is_empty() {
        return Ok(None);
    }
    let mean = left.rates.iter().sum::<Vector3<f64>>() / left.rates.len() as f64;
    let size = mean.norm();
    if size > FOREIGN_RATE {
        return Err(Error::input(format!(
            "{name}: corrected by this calibration the rate at rest is {size:.2} rad/s, where it should be zero: the \
             calibration is of another device or for another unit of the gyroscope (--force-device to go on)"
        )));
    }
    Ok((size > MOVED_RATE).then(|| {
        format!(
            "{name}: corrected by this calibration the rate at rest is {:.4}, {:.4}, {:.4} rad/s, where it should be zero: is it \
             of this device? `stillpoint bias` estimates the bias again",
            mean.x, mean.y, mean.z
        )
    }))
}

fn direction_in_doubt(
    name: &str,
    calibration: &Calibration,
    segmentation: &Segmentation,
    left: &Misfits,
) -> Result<Option<String>, Error> {
    let Some(triad) = &calibration.gyroscope else {
        return Ok(None);
    };
    let short = left.turns.iter().filter(|turn| {
        let own = segmentation.turns.iter().find(|t| t.from == turn.index);
        own.is_some_and(|t| t.span.length() < LONGEST_TURN)
    });
    let angles: Vec<f64> = short.map(|turn| turn.value).collect();
    if angles.len() < ENOUGH_TURNS || calibration.accelerometer.is_none() {
        return Ok(None);
    }
    let rms = root_mean_square(&angles);
    let usual = triad.residual_rms;
    // A calibration that misses its own recordings as much is bad, not foreign: its gate has said so.
    if rms > FOREIGN_ANGLE.max(WORSE * usual) {
        return Err(Error::input(format!(
            "{name}: corrected by this calibration the gyroscope misses gravity by {rms:.0}° through {} turns: it is of another \
             device, or for another unit, sign or order of the axes (--force-device to go on)",
            angles.len()
        )));
    }
    Ok((rms > (WORSE * usual).max(FINE.0)).then(|| {
        format!(
            "{name}: corrected by this calibration the gyroscope misses gravity by {rms:.2}° through {} turns{}: is it of this device?",
            angles.len(),
            left_of_its_own(usual, |usual| format!("{usual:.2}°"))
        )
    }))
}

fn norm_in_doubt(name: &str, calibration: &Calibration, left: &Misfits) -> Option<String> {
    let usual = calibration.accelerometer.as_ref()?.residual_rms;
    let values: Vec<f64> = left.rests.iter().map(|rest| rest.value).collect();
    let rms = root_mean_square(&values);
    (!values.is_empty() && rms > (WORSE * usual).max(FINE.1)).then(|| {
        format!(
            "{name}: corrected by this calibration the specific force at rest differs from gravity by {rms:.3} m/s² rms{}: is it of this device?",
            left_of_its_own(usual, |usual| format!("{usual:.3}"))
        )
    })
}

/// What a calibration left of its own recordings; nothing of one that another tool made, which does not say.
fn left_of_its_own(usual: f64, shown: impl Fn(f64) -> String) -> String {
    match usual > 0.0 {
        true => format!("; it left {} of its own recordings", shown(usual)),
        false => String::new(),
    }
}
