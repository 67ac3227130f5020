//! The unit of raw readings, as `T` shows it.

use std::ops::Range;

use sensor::Sensor;
use serde::{Deserialize, Serialize};

/// SI units per unit of the reading where the reading is in SI units.
const SI: Range<f64> = 0.5..2.0;
/// The same of g.
const G: Range<f64> = 9.0..10.6;
/// The same of degrees per second.
const DEGREES: Range<f64> = 0.015..0.0205;
/// Microtesla per unit of the reading where that is gauss.
const GAUSS: Range<f64> = 50.0..200.0;

/// Units of one sensor's numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TriadUnits {
    /// Unit of a raw reading, and so of `bias` and `bias_std`: `m/s^2`, `rad/s`, `uT`, `g`, `deg/s`, `gauss` or `count`.
    pub reading: String,
    /// Unit of `T` and `T_std`: `1` where the reading is in SI units, else such as `(m/s^2)/count`.
    #[serde(rename = "T")]
    pub t: String,
    /// Unit of the corrected signal: `m/s^2`, `rad/s` or `uT`.
    pub corrected: String,
}

impl TriadUnits {
    /// By the `scale` of `T`, SI units per unit of the reading.
    pub fn of(sensor: Sensor, scale: f64) -> Self {
        let (corrected, other, name) = match sensor {
            Sensor::Accelerometer => ("m/s^2", G, "g"),
            Sensor::Gyroscope => ("rad/s", DEGREES, "deg/s"),
            Sensor::Magnetometer => ("uT", GAUSS, "gauss"),
        };
        let reading = if SI.contains(&scale) {
            corrected
        } else if other.contains(&scale) {
            name
        } else {
            "count"
        };
        let t = match reading == corrected {
            true => "1".to_owned(),
            false if reading.contains('/') => format!("({corrected})/({reading})"),
            false => format!("({corrected})/{reading}"),
        };
        Self {
            reading: reading.into(),
            t,
            corrected: corrected.into(),
        }
    }
}
