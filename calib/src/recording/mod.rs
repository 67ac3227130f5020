//! What a device recorded, in SI units, each sensor on its own clock.

mod stream;

pub use stream::{Stream, Temperature};

/// One recording of one device.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// Where it came from, as the user named it.
    pub name: String,
    /// Specific force, m/s² (or raw counts).
    pub accelerometer: Option<Stream>,
    /// Angular rate, rad/s (or raw counts).
    pub gyroscope: Option<Stream>,
    /// Temperature, °C.
    pub temperature: Option<Temperature>,
    /// What the reader noticed and went on with.
    pub warnings: Vec<String>,
}
