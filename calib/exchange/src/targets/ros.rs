//! ROS: the file of dpkoch/imu_calib, `out = SM raw − bias`.

use std::fmt::Write as _;

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::error::Error;
use crate::kept::Kept;
use crate::source::{Source, rows};
use crate::target::{Form, Settings, Target, Written};

/// `SM = T`, `bias = T b` (`AccelCalib::loadCalib` and `applyCalib` in `src/accel_calib/accel_calib.cpp`). The node has no
/// parameters of the gyroscope: it takes off the mean of its first samples.
pub const TARGET: Target = Target {
    name: "ros",
    about: "ROS imu_calib's yaml: f = SM A - bias; the accelerometer only",
    form: Form::File,
    keeps: |source| Kept {
        accelerometer: source.accelerometer,
        ..Kept::default()
    },
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    source.needs_si("ros")?;
    let base = source.needs(Sensor::Accelerometer, "ros")?;
    let mut text = source.provenance("#");
    let sequence = |text: &mut String, key: &str, values: &[f64]| {
        let _ = writeln!(text, "{key}:");
        for value in values {
            let _ = writeln!(text, "  - {value:?}");
        }
    };
    sequence(&mut text, "SM", &rows(&base.t));
    sequence(&mut text, "bias", (base.t * base.bias).as_slice());
    Ok(Written {
        notes: vec![Finding::of(Kind::BIAS_FROM_START)],
        ..Written::text(text)
    })
}
