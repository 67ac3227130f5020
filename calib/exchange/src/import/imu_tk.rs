//! imu_tk's two texts.

use calib::Calibration;
use findings::{Finding, Findings, Kind};
use nalgebra::{Matrix3, Vector3};
use sensor::Base;

use super::calibration;
use crate::error::Error;

/// Misalignment matrix, scale matrix, bias.
const NUMBERS: usize = 21;

/// A calibration of imu_tk: the texts that `CalibratedTriad_::save` writes of accelerometer and gyroscope,
/// `X' = T K (X − B)`.
///
/// # Errors
/// What is no number, and too few or too many.
///
/// # Examples
/// ```
/// let text = "1 0 0\n0 1 0\n0 0 1\n\n2 0 0\n0 2 0\n0 0 2\n\n.1\n.2\n.3\n";
/// let calibration = stillpoint_exchange::import::imu_tk(text, text)?;
/// assert_eq!(calibration.accelerometer.map(|a| a.t[1][1]), Some(2.0));
/// # Ok::<(), stillpoint_exchange::Error>(())
/// ```
pub fn imu_tk(accelerometer: &str, gyroscope: &str) -> Result<Calibration, Error> {
    let accelerometer = base(accelerometer, "accelerometer")?;
    let gyroscope = base(gyroscope, "gyroscope")?;
    let unstated = Finding::of(Kind::ERRORS_NOT_STATED).detail("tool", "imu_tk");
    Ok(calibration(
        "imu_tk",
        Some(&accelerometer),
        Some(&gyroscope),
        None,
        Findings::from_iter([unstated]),
    ))
}

fn base(text: &str, sensor: &str) -> Result<Base<f64>, Error> {
    let mut all = Vec::new();
    for (k, line) in text.lines().enumerate() {
        for word in line.split_whitespace() {
            let value = word.parse().ok().filter(|v: &f64| v.is_finite());
            all.push(value.ok_or_else(|| {
                let found = Finding::of(Kind::MATRIX_NUMBER_EXPECTED).detail("of", sensor);
                Error::input(found.count("line", k + 1))
            })?);
        }
    }
    if all.len() != NUMBERS {
        let found = Finding::of(Kind::NUMBERS_COUNT).detail("of", sensor);
        let found = found.count("found", all.len());
        return Err(Error::input(found.count("expected", NUMBERS)));
    }
    let t = Matrix3::from_row_slice(&all[..9]) * Matrix3::from_row_slice(&all[9..18]);
    let base = Base {
        t,
        bias: Vector3::from_column_slice(&all[18..]),
    };
    match t.try_inverse() {
        Some(_) => Ok(base),
        None => {
            let found = Finding::of(Kind::ENTRY_SINGULAR);
            Err(Error::input(found.detail("entry", sensor)))
        }
    }
}
