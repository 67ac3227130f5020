//! Evaluation of a calibration on a recording that was not used for it.

use std::borrow::Cow;

use calib::calibration::{check_units, doubts, in_unit_of};
use calib::gravity::GravitySource;
use calib::methods::cut;
use calib::watch::Stage;
use findings::Findings;

use crate::{Calibration, Error, Evaluation, Recording, Request};

/// Measures a calibration on a recording, or the raw readings with `None`: the norm of specific force over static
/// intervals (m/s²), the direction of gravity after each turn (°), the rate at rest (rad/s). Of the request gravity or
/// place, the detector, `force_device` and the watch count.
///
/// # Errors
/// A recording that cannot be cut, readings of another unit or device (unless `force_device`), an effect that needs what
/// cannot be known of it.
///
/// # Examples
/// ```
/// use stillpoint::{Recording, Request, calibrate, evaluate};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let request = Request::default();
/// let calibration = calibrate(&[recording.clone()], &request)?;
/// let raw = evaluate(&recording, None, &request)?;
/// let corrected = evaluate(&recording, Some(&calibration), &request)?;
/// assert!(corrected.modulus_rms < raw.modulus_rms);
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn evaluate(
    recording: &Recording,
    calibration: Option<&Calibration>,
    request: &Request,
) -> Result<Evaluation, Error> {
    let how = request.for_calibration(1)?;
    let recording = recording.at_hand_speed();
    let calibration = calibration.map(AsRef::as_ref);
    let recording = Cow::Borrowed(recording.as_ref());
    let recording = match calibration {
        Some(calibration) => in_unit_of(calibration, recording)?,
        None => recording,
    };
    let recording = recording.as_ref();
    how.watch.step(Stage::Cutting)?;
    let mut warnings = Findings::new();
    if let Some(calibration) = calibration {
        if !request.force_device {
            check_units(calibration, recording)?;
            warnings.extend(doubts(calibration, recording)?);
        }
        warnings.extend(calibration.doubts_biases_of(recording));
    }
    let gravity = match (how.gravity_source, calibration) {
        (GravitySource::Assumed, Some(calibration)) => calibration.gravity,
        _ => how.gravity,
    };
    let choice = cut(recording, &how.detector, how.choose_multiplier, gravity)?;
    let left = calib::evaluate(recording, &choice.segmentation, calibration, gravity)?;
    if warnings.is_empty() {
        warnings.extend(left.warnings.clone());
    }
    Ok(Evaluation { warnings, ..left })
}
