//! PX4: a parameter file as QGroundControl loads it.

use std::fmt::Write as _;

use findings::{Finding, Kind};
use sensor::Sensor;

use super::in_force::{Controller, Names};
use crate::error::Error;
use crate::kept::Kept;
use crate::source::{Source, by_axis};
use crate::target::{Form, Settings, Target, Written};

/// `MAV_PARAM_TYPE_REAL32`.
const REAL32: u8 = 9;

/// Scale factors that PX4 takes: `@min 0.1`, `@max 3.0` of `CAL_ACC0_XSCALE` and its sisters in the parameters of
/// `src/modules/sensors`. Offsets have no limits.
const SCALES: (f64, f64) = (0.1, 3.0);

/// Sensors of a kind that PX4 has parameters for.
const MOST: usize = 4;

/// `(data − offset) · scale` per axis for the accelerometer, `data − offset` for the gyroscope
/// (`Accelerometer::Correct` and `Gyroscope::Correct` in `src/lib/sensor_calibration`).
pub const TARGET: Target = Target {
    name: "px4",
    about: "PX4 parameters (CAL_ACC0_XOFF, CAL_ACC0_XSCALE, CAL_GYRO0_XOFF, ...)",
    form: Form::File,
    keeps: Kept::offsets_and_scales_of,
    write,
};

fn write(source: &Source<'_>, settings: &Settings) -> Result<Written, Error> {
    source.needs_si("px4")?;
    source.needs_signs("px4")?;
    let k = settings.instance;
    if k >= MOST {
        let found = Finding::of(Kind::INSTANCE_BEYOND).detail("system", "PX4");
        let found = found.count("instance", k);
        return Err(Error::settings(found.count("most", MOST - 1)));
    }
    let controller = Controller {
        system: "px4",
        turning: vec![
            "SENS_BOARD_ROT".into(),
            format!("CAL_ACC{k}_ROT"),
            format!("CAL_GYRO{k}_ROT"),
        ],
        raw: "sensor_accel and sensor_gyro",
    };
    let mut text = String::from("# Onboard parameters for Vehicle 1\n#\n");
    text.push_str(&source.provenance("#"));
    text.push_str(Controller::remark(settings));
    text.push_str("#\n# Vehicle-Id Component-Id Name Value Type\n");
    let mut put = |name: String, value: f64| {
        // PX4 keeps 32-bit floats.
        let _ = writeln!(text, "1\t1\t{name}\t{:?}\t{REAL32}", value as f32);
    };
    if let Some(base) = &source.accelerometer {
        let names = Names {
            offset: format!("CAL_ACC{k}_{{axis}}OFF"),
            scale: Some(format!("CAL_ACC{k}_{{axis}}SCALE")),
        };
        let sensor = (Sensor::Accelerometer, base);
        let raw = controller.for_raw(source, sensor, &names, settings)?;
        // A zero in place of what is not known would erase the vehicle's own.
        if source.knows_bias(Sensor::Accelerometer) {
            for (axis, value) in by_axis(raw.bias) {
                put(format!("CAL_ACC{k}_{axis}OFF"), value);
            }
        }
        for (axis, value) in by_axis(raw.t.diagonal()) {
            let name = format!("CAL_ACC{k}_{axis}SCALE");
            if !(SCALES.0..=SCALES.1).contains(&value) {
                return Err(Error::outside("px4", name, value, SCALES));
            }
            put(name, value);
        }
    }
    let gyroscope = source.gyroscope.as_ref();
    if let Some(base) = gyroscope.filter(|_| source.knows_bias(Sensor::Gyroscope)) {
        let names = Names {
            offset: format!("CAL_GYRO{k}_{{axis}}OFF"),
            scale: None,
        };
        let sensor = (Sensor::Gyroscope, base);
        let raw = controller.for_raw(source, sensor, &names, settings)?;
        for (axis, value) in by_axis(raw.bias) {
            put(format!("CAL_GYRO{k}_{axis}OFF"), value);
        }
    }
    let ids = format!("CAL_ACC{k}_ID and CAL_GYRO{k}_ID");
    let mut notes = vec![Finding::of(Kind::SENSORS_BY_IDS).detail("ids", ids)];
    if Controller::is_unknown(source, settings) {
        notes.push(
            Finding::of(Kind::MAYBE_CORRECTED)
                .detail("system", "PX4")
                .detail("stream", "sensor_combined"),
        );
    }
    Ok(Written {
        notes,
        ..Written::text(text)
    })
}
