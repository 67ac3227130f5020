//! ArduPilot: a parameter file as Mission Planner and MAVProxy load it.

use std::fmt::Write as _;

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::in_force::{Controller, Names};
use crate::error::Error;
use crate::kept::Kept;
use crate::source::{Source, by_axis};
use crate::target::{Form, Settings, Target, Written};

/// Ranges that ArduPilot accepts for a scale factor and for an offset (m/s²): `@Range: 0.8 1.2` of `ACCSCAL_X` and
/// `-3.5 3.5` of `ACCOFFS_X` in `AP_InertialSensor_Params.cpp`. Its own calibration refuses scale factors outside this
/// range too, but offsets only from 1 g on (`AccelCalibrator::accept_result`).
const SCALES: (f64, f64) = (0.8, 1.2);
const OFFSETS: (f64, f64) = (-3.5, 3.5);

/// `accel −= offset; accel *= scale` per axis, `gyro −= offset`
/// (`_rotate_and_correct_accel` and `_rotate_and_correct_gyro` in `AP_InertialSensor_Backend.cpp`).
///
/// A log holds readings that were corrected already, by `s` and `o`: a calibration `d`, `b` of those makes
/// `d (s (raw − o) − b) = s d (raw − (o + b / s))`.
pub const TARGET: Target = Target {
    name: "ardupilot",
    about: "ArduPilot parameters (INS_ACCOFFS_X, INS_ACCSCAL_X, INS_GYROFFS_X, ...)",
    form: Form::File,
    keeps: Kept::offsets_and_scales_of,
    write,
};

fn write(source: &Source<'_>, settings: &Settings) -> Result<Written, Error> {
    source.needs_si("ardupilot")?;
    source.needs_signs("ardupilot")?;
    let [acc, gyro] = numbered(settings.instance)?;
    let controller = Controller {
        system: "ardupilot",
        turning: vec!["AHRS_ORIENTATION".into()],
        raw: "its raw batches (INS_LOG_BAT_MASK)",
    };
    let mut text = source.provenance("#") + Controller::remark(settings);
    let mut put = |name: &str, values: Vector3<f64>, limits: Option<(f64, f64)>| {
        for (axis, value) in by_axis(values) {
            let name = format!("{name}_{axis}");
            if let Some(limits) = limits.filter(|(a, b)| !(*a..=*b).contains(&value)) {
                return Err(Error::outside("ardupilot", name, value, limits));
            }
            let _ = writeln!(text, "{name},{:?}", value as f32);
        }
        Ok(())
    };
    if let Some(base) = &source.accelerometer {
        let (offset, scale) = (format!("{acc}OFFS"), format!("{acc}SCAL"));
        let names = Names {
            offset: format!("{offset}_{{axis}}"),
            scale: Some(format!("{scale}_{{axis}}")),
        };
        let sensor = (Sensor::Accelerometer, base);
        let raw = controller.for_raw(source, sensor, &names, settings)?;
        // A zero in place of what is not known would erase the vehicle's own.
        if source.knows_bias(Sensor::Accelerometer) {
            put(&offset, raw.bias, Some(OFFSETS))?;
        }
        put(&scale, raw.t.diagonal(), Some(SCALES))?;
    }
    let gyroscope = source.gyroscope.as_ref();
    if let Some(base) = gyroscope.filter(|_| source.knows_bias(Sensor::Gyroscope)) {
        let offset = format!("{gyro}OFFS");
        let names = Names {
            offset: format!("{offset}_{{axis}}"),
            scale: None,
        };
        let sensor = (Sensor::Gyroscope, base);
        let raw = controller.for_raw(source, sensor, &names, settings)?;
        put(&offset, raw.bias, None)?;
    }
    let mut notes = vec![
        Finding::of(Kind::OFFSETS_MEASURED_AGAIN)
            .detail("system", "ArduPilot")
            .detail("parameter", "INS_GYR_CAL"),
    ];
    if Controller::is_unknown(source, settings) {
        notes.push(
            Finding::of(Kind::MAYBE_CORRECTED)
                .detail("system", "ArduPilot")
                .detail("stream", "its log"),
        );
    }
    Ok(Written {
        notes,
        ..Written::text(text)
    })
}

/// Returns the prefixes of the accelerometer and gyroscope parameters of an instance.
fn numbered(instance: usize) -> Result<[&'static str; 2], Error> {
    match instance {
        0 => Ok(["INS_ACC", "INS_GYR"]),
        1 => Ok(["INS_ACC2", "INS_GYR2"]),
        2 => Ok(["INS_ACC3", "INS_GYR3"]),
        _ => {
            let found = Finding::of(Kind::INSTANCE_BEYOND).detail("system", "ArduPilot");
            Err(Error::settings(
                found.count("instance", instance).count("most", 2),
            ))
        }
    }
}
