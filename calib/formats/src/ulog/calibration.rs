//! The calibration that PX4 has already applied to `sensor_combined`, taken off again.
//!
//! PX4 corrects by `(raw - offset) scale`, gyroscopes by `raw - offset`
//! (src/lib/sensor_calibration/Accelerometer.hpp and Gyroscope.hpp, `Correct`).

use std::collections::HashMap;

use crate::bytes::Fields;
use crate::{Content, Quantity};

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
}

/// Takes the corrections off the streams of `sensor_combined` where the log has them, and says what was done.
pub(super) fn undo(content: &mut Content, parameters: &Parameters, selected: Option<[u32; 2]>) {
    if !content
        .streams
        .iter()
        .any(|stream| stream.processed && !stream.stamps.is_empty())
    {
        return;
    }
    let turned = parameters.get("SENS_BOARD_ROT").unwrap_or(0.0) != 0.0;
    let mut undone = Vec::new();
    for stream in content.streams.iter_mut().filter(|stream| stream.processed) {
        let (kind, at) = match stream.quantity {
            Quantity::SpecificForce => ("ACC", 0),
            Quantity::AngularRate => ("GYRO", 1),
            _ => continue,
        };
        let sensor = selected
            .and_then(|ids| parameters.sensor(kind, ids[at]))
            .filter(|_| !turned);
        let Some(sensor) = sensor else { continue };
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
            continue;
        }
        for sample in &mut stream.values {
            for axis in 0..3 {
                sample[axis] = sample[axis] / scale[axis] + offset[axis];
            }
        }
        undone.push(format!("CAL_{kind}{sensor}"));
    }
    content.warnings.push(match undone.len() {
        2 => format!("sensor_combined is what PX4 has corrected; its {} and {} are taken off again", undone[0], undone[1]),
        _ => "sensor_combined is what PX4 has corrected by parameters that the log does not tell in full: the calibration is on top of PX4's own".to_owned(),
    });
}
