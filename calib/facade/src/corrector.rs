//! Corrections of readings one by one, as they come from a device.

use calib::truth::{Corrector as Inner, Sample};
use nalgebra::Vector3;

use crate::calibration::Calibration;
use crate::error::Error;

/// Corrects readings one by one: base model plus effects.
///
/// # Examples
/// ```
/// use stillpoint::{Corrector, Recording, Request, Sensor, apply, calibrate};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let calibration = calibrate(&[recording.clone()], &Request::default())?;
/// let mut corrector = Corrector::of(&calibration)?;
/// let (force, rate) = corrector.correct(t[0], accel[0], gyro[0], None);
/// let whole = apply(&calibration, &recording)?;
/// assert_eq!(whole.values(Sensor::Gyroscope).next(), Some(rate));
/// assert_eq!(whole.values(Sensor::Accelerometer).next(), Some(force));
/// # Ok::<(), stillpoint::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Corrector(Inner);

impl Corrector {
    /// Builds the corrector of a calibration.
    ///
    /// # Errors
    /// [`ErrorKind::NotEnoughInformation`](crate::ErrorKind::NotEnoughInformation) for an effect that depends on more
    /// than one instant, such as a hysteresis: [`apply`](crate::apply) corrects a whole recording with it.
    pub fn of(calibration: &Calibration) -> Result<Self, Error> {
        Ok(Self(Inner::of(calibration.inner())?))
    }

    /// Specific force (m/s²) and angular rate (rad/s) behind the raw readings at `t` (s); a temperature (°C) holds until the next one.
    pub fn correct(
        &mut self,
        t: f64,
        accel: [f64; 3],
        gyro: [f64; 3],
        temperature: Option<f64>,
    ) -> ([f64; 3], [f64; 3]) {
        let corrected = self.0.correct(&Sample {
            t,
            accelerometer: Some(Vector3::from(accel)),
            gyroscope: Some(Vector3::from(gyro)),
            temperature,
        });
        let array = |signal: Option<Vector3<f64>>, raw| signal.map_or(raw, Vector3::into);
        (
            array(corrected.accelerometer, accel),
            array(corrected.gyroscope, gyro),
        )
    }
}
