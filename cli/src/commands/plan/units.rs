//! Units of parameters.

use sensor::{BasePart, Sensor, base_part};

/// The factor from SI and the unit that people use.
pub fn unit_of(name: &str) -> (f64, &'static str) {
    match base_part(name) {
        Some((Sensor::Accelerometer, BasePart::Bias)) => (1e3, "mm/s²"),
        Some((Sensor::Gyroscope, BasePart::Bias)) => (3600_f64.to_degrees(), "°/h"),
        Some((_, BasePart::ScaleFactor)) => (1e6, "ppm"),
        _ => (1e3, "mrad"),
    }
}
