//! The calibration that PX4 has already applied to `sensor_combined`, taken off again.
//!
//! PX4 corrects by `(raw - offset) scale`, gyroscopes by `raw - offset`
//! (src/lib/sensor_calibration/Accelerometer.hpp and Gyroscope.hpp, `Correct`).

use findings::{Finding, Kind};
use std::collections::HashMap;

use crate::bytes::Fields;
use crate::{Content, Correction, Quantity};

/// Parameters by name.
#[derive(Debug, Default)]
pub(super) struct Parameters(HashMap<String, f64>);

/// Sensors that parameters are kept for.
const SENSORS: usize = 4;

impl Parameters {
    /// Takes over `float NAME` or `int32_t NAME` with its value; the last value holds.
    pub fn add(&mut self, body: &[u8]) {
        let mut fields = Fields(body);
        let parsed = || {
            let length = fields.u8()?;
            let key = std::str::from_utf8(fields.bytes(usize::from(length))?).ok()?;
            let (kind, name) = key.split_once(' ')?;
            let value = match kind {
                "float" => f64::from(fields.f32()?),
                "int32_t" => f64::from(fields.i32()?),
                _ => return None,
            };
            Some((name.to_owned(), value))
        };
        self.0.extend({ parsed }());
    }

    fn get(&self, name: &str) -> Option<f64> {
        self.0.get(name).copied()
    }

    /// The number of the sensor with this device id.
    fn sensor(&self, kind: &str, id: u32) -> Option<usize> {
        (0..SENSORS).find(|k| {
            let stored = self.get(&format!("CAL_{kind}{k}_ID"));
            // Ids are stored as signed numbers.
            stored.is_some_and(|stored| stored as i64 as u32 == id && id != 0)
        })
    }

    /// The one sensor that is calibrated, where there is one.
    fn only(&self, kind: &str) -> Option<usize> {
        let is_there = |k: &usize| {
            self.get(&format!("CAL_{kind}{k}_ID"))
                .is_some_and(|id| id != 0.0)
        };
        let mut there = (0..SENSORS).filter(is_there);
        let first = there.next();
        first.filter(|_| there.next().is_none())
    }
}

/// Returns the mounting of the board: for each axis of the vehicle, the sensor's axis and its sign. Covers the common rotations by
/// quarter and half turns (PX4's `enum Rotation`); `None` for others.
fn mounting(rotation: f64) -> Option<[(usize, f64); 3]> {
    Some(match rotation as i64 {
        0 => [(0, 1.0), (1, 1.0), (2, 1.0)],
        2 => [(1, -1.0), (0, 1.0), (2, 1.0)],
        4 => [(0, -1.0), (1, -1.0), (2, 1.0)],
        6 => [(1, 1.0), (0, -1.0), (2, 1.0)],
        8 => [(0, 1.0), (1, -1.0), (2, -1.0)],
        12 => [(0, -1.0), (1, 1.0), (2, -1.0)],
        _ => return None,
    })
}

/// Takes the corrections off the streams of `sensor_combined` where the log has them, and says what was done.
pub(super) fn undo(content: &mut Content, parameters: &Parameters, selected: Option<[u32; 2]>) {
    if content.corrected().next().is_none() {
        return;
    }
    let mounting = mounting(parameters.get("SENS_BOARD_ROT").unwrap_or(0.0));
    let mut undone = Vec::new();
    let mut left = false;
    for stream in content.corrected() {
        let (kind, at) = match stream.quantity {
            Quantity::SpecificForce => ("ACC", 0),
            Quantity::AngularRate => ("GYRO", 1),
            _ => continue,
        };
        let mut correction = Correction {
            by: "px4",
            undone: false,
        };
        stream.correction = Some(correction);
        let sensor = match selected {
            Some(ids) => parameters.sensor(kind, ids[at]),
            None => parameters.only(kind),
        };
        let Some((sensor, mounting)) = sensor.zip(mounting) else {
            left = true;
            continue;
        };
        let value = |what: &str, axis: &str, default: f64| {
            let value = parameters.get(&format!("CAL_{kind}{sensor}_{axis}{what}"));
            value.unwrap_or(default)
        };
        let offset = ["X", "Y", "Z"].map(|axis| value("OFF", axis, 0.0));
        let scale = match kind {
            "ACC" => ["X", "Y", "Z"].map(|axis| value("SCALE", axis, 1.0)),
            _ => [1.0; 3],
        };
        if scale.iter().any(|scale| !(0.5..2.0).contains(scale)) {
            left = true;
            continue;
        }
        for sample in &mut stream.values {
            let mut raw = [0.0; 3];
            for (value, (axis, sign)) in sample.iter().zip(mounting) {
                raw[axis] = sign * value;
            }
            for axis in 0..3 {
                raw[axis] = raw[axis] / scale[axis] + offset[axis];
            }
            *sample = raw;
        }
        correction.undone = true;
        stream.correction = Some(correction);
        undone.push(format!("CAL_{kind}{sensor}"));
    }
    let kind = match left {
        true => Kind::CORRECTED_BY_SYSTEM,
        false => Kind::CORRECTION_UNDONE,
    };
    let are = if undone.len() == 1 { "is" } else { "are" };
    content.warnings.push(
        Finding::of(kind)
            .detail("system", "PX4")
            .detail("columns", "sensor_combined")
            .detail("parameters", format!("{} {are}", undone.join(" and "))),
    );
}
