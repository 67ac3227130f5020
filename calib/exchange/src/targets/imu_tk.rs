//! imu_tk: two text files, `X' = T K (X − B)`.

use std::fmt::Write as _;

use findings::{Finding, Kind};
use sensor::{Base, Sensor};

use crate::error::Error;
use crate::kept::Kept;
use crate::source::{Source, diagonal};
use crate::target::{Form, Settings, Target, Written};

/// Tedaldi, Pretto and Menegatti's imu_tk reads per sensor the misalignment matrix `T`, the scale matrix `K` and the bias
/// `B`, 21 numbers in rows (`CalibratedTriad_::load` and `unbiasNormalize` in `include/imu_tk/calibration.h`).
///
/// `K = diag T`, `T' = T K⁻¹`.
pub const TARGET: Target = Target {
    name: "imu_tk",
    about: "imu_tk: a folder with acc.calib and gyro.calib, f = T K (A - B)",
    form: Form::Folder(&["acc.calib", "gyro.calib"]),
    keeps: Kept::base_of,
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let accelerometer = source.needs(Sensor::Accelerometer, "imu_tk")?;
    let gyroscope = source.needs(Sensor::Gyroscope, "imu_tk")?;
    Ok(Written {
        files: vec![text(accelerometer)?, text(gyroscope)?],
        notes: Vec::new(),
    })
}

fn text(base: &Base<f64>) -> Result<Vec<u8>, Error> {
    let scale = diagonal(&base.t);
    let inverse = scale
        .try_inverse()
        .ok_or_else(|| Error::format(Finding::of(Kind::SCALE_ZERO).detail("target", "imu_tk")))?;
    let mut text = String::new();
    for matrix in [base.t * inverse, scale] {
        for row in matrix.row_iter() {
            let _ = writeln!(text, "{:.17e} {:.17e} {:.17e}", row[0], row[1], row[2]);
        }
        text.push('\n');
    }
    for b in base.bias.iter() {
        let _ = writeln!(text, "{b:.17e}");
    }
    Ok(text.into_bytes())
}
