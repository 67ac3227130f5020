//! Recordings to a calibration.

use calib::calibrate::calibrate as calibrate_all;
use calib::limits::built_in;
use calib::methods::six_position;
use calib::watch::Stage;
use findings::{Finding, Kind, Level};

use crate::{Calibration, Error, Method, Recording, Request};

/// Settings that mean nothing where each axis is held up and down once.
const IGNORED: [&str; 7] = [
    "effects",
    "sections",
    "left_out",
    "gyro_recordings",
    "nominal_rate",
    "field",
    "catalogue",
];

/// Calibrates both sensors from recordings of one device: scale factors, misalignments and biases with standard errors.
///
/// Several recordings share scale factors and misalignments and have biases of their own where the data ask for it. The
/// result is that of the command with the same options, bit for bit.
///
/// # Errors
/// A request that contradicts itself; recordings that cannot be cut, that have too few orientations, that do not
/// determine a parameter, or are of different devices; a fit that does not converge; the end by a
/// [`Watch`](crate::Watch).
///
/// # Examples
/// ```
/// use stillpoint::{Recording, Request, calibrate};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let request = Request { gravity: Some(9.80665), ..Request::default() };
/// let calibration = calibrate(&[recording], &request)?;
/// let scale = &calibration.parameters()[0];
/// assert_eq!(scale.name, "accel.s_x");
/// assert!((scale.value - 1.0).abs() < 0.05 && scale.std.unwrap() < 1e-3);
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn calibrate(recordings: &[Recording], request: &Request) -> Result<Calibration, Error> {
    if recordings.is_empty() {
        return Err(Error::usage(Finding::of(Kind::RECORDINGS_MISSING)));
    }
    let how = request.for_calibration(recordings.len())?;
    let slow = |all: &[Recording]| all.iter().map(Recording::at_hand_speed).collect();
    let recordings: Vec<Recording> = slow(recordings);
    let others: Vec<Recording> = slow(&request.gyro_recordings);
    let all: Vec<&calib::Recording> = recordings.iter().map(AsRef::as_ref).collect();
    let turned: Vec<&calib::Recording> = others.iter().map(AsRef::as_ref).collect();
    if let Method::SixPosition { first_order } = request.method {
        request.refuse("six-position", &IGNORED)?;
        let gravity = request.local_gravity()?;
        how.watch.step(Stage::Fitting)?;
        let mut solved = six_position::calibrate(&all, &how.detector, gravity, first_order)?;
        let limits = built_in(&solved.calibration);
        solved.calibration.state_limits(limits);
        return Ok(Calibration::of(solved.calibration));
    }
    let mut outcome = calibrate_all(&all, &turned, &how)?;
    if let Some(own) = outcome.calibration.not_calibrated.first() {
        let found = Finding::of(Kind::NOT_CALIBRATED)
            .of_sensor(own.sensor)
            .detail("why", own.text.clone());
        return Err(calib::Error::not_enough(found.at_level(Level::Error)).into());
    }
    let limits = built_in(&outcome.calibration);
    outcome.calibration.state_limits(limits);
    Ok(Calibration::made(outcome, recordings))
}
