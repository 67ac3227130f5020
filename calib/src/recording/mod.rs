//! What a device recorded, in SI units, each sensor on its own clock.

mod stream;
mod write;

pub use stream::{Stream, Temperature};
pub use write::{stream_to_csv, to_csv};

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

impl Recording {
    /// The earliest time stamp, s.
    pub fn start(&self) -> f64 {
        [&self.accelerometer, &self.gyroscope]
            .into_iter()
            .flatten()
            .filter_map(|stream| stream.t.first().copied())
            .fold(f64::INFINITY, f64::min)
    }
}
