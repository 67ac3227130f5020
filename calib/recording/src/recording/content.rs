//! One recording of one device.

use findings::{Finding, Findings, Kind};
use sensor::Sensor;

use super::description::{Description, UnitBy};
use super::frozen::Frozen;
use super::magnetometer::Magnetometer;
use super::scalar::ScalarStream;
use super::stream::{Stream, Temperature};
use crate::units::{AccelUnit, GyroUnit};

/// One recording of one device.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// Name of the file, as the user gave it.
    pub name: String,
    /// Stamp in the file at `t = 0`, ns: stamps since 1970, whose first is taken off, keep their digits. Zero where `t` is the file's own.
    pub zero_ns: i128,
    /// Specific force, m/s² (or raw counts).
    pub accelerometer: Option<Stream>,
    /// Angular rate, rad/s (or raw counts).
    pub gyroscope: Option<Stream>,
    /// Temperature, °C.
    pub temperature: Option<Temperature>,
    /// Magnetic field, as the file has it.
    pub magnetometer: Option<Magnetometer>,
    /// Readings of sensors of one dimension, in the order in which they were added.
    pub scalars: Vec<ScalarStream>,
    /// Runs in which a sensor repeated one reading; the repetitions are left out of its stream.
    pub frozen: Vec<Frozen>,
    /// Warnings of the reader.
    pub warnings: Findings,
    /// Format and columns that the samples come from.
    pub description: Description,
}

impl Recording {
    /// Returns true if the readings of a sensor are raw counts.
    pub fn is_in_counts(&self, sensor: Sensor) -> bool {
        let mut described = self.description.sensors.iter();
        described.any(|d| d.sensor == sensor && d.unit == AccelUnit::Counts.name())
    }

    /// The readings of a sensor.
    pub fn stream(&self, sensor: Sensor) -> Option<&Stream> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_ref(),
            Sensor::Gyroscope => self.gyroscope.as_ref(),
            Sensor::Magnetometer => self.magnetometer.as_ref().map(|field| &field.stream),
        }
    }

    /// Says that rad/s is assumed for the gyroscope, where neither the file nor the readings tell its unit.
    pub fn unit_assumed(&self) -> Option<Finding> {
        let si = GyroUnit::RadiansPerSecond.name();
        let described = self.description.of(Sensor::Gyroscope)?;
        let is_assumed = described.unit_by == UnitBy::Nothing && described.unit == si;
        let finding = Finding::of(Kind::UNIT_ASSUMED).in_recording(&self.name);
        is_assumed.then(|| finding.of_sensor(described.sensor))
    }

    /// The readings of a sensor, to be changed.
    pub fn stream_mut(&mut self, sensor: Sensor) -> Option<&mut Stream> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_mut(),
            Sensor::Gyroscope => self.gyroscope.as_mut(),
            Sensor::Magnetometer => self.magnetometer.as_mut().map(|field| &mut field.stream),
        }
    }

    /// The earliest time stamp of what is calibrated, s; of the magnetometer, where it is alone.
    pub fn start(&self) -> f64 {
        let calibrated = [&self.accelerometer, &self.gyroscope];
        let field = self.magnetometer.as_ref().map(|field| &field.stream);
        let first = |stream: &Stream| stream.t.first().copied();
        let earliest = calibrated.into_iter().flatten().filter_map(first);
        let earliest = earliest.reduce(f64::min);
        let earliest = earliest.or_else(|| field.and_then(first));
        earliest.unwrap_or(f64::INFINITY)
    }

    /// The last stamp of accelerometer and gyroscope, s; −∞ without both.
    pub fn end(&self) -> f64 {
        let both = [&self.accelerometer, &self.gyroscope];
        let last = both
            .into_iter()
            .flatten()
            .filter_map(|stream| stream.t.last());
        last.copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// True where a magnetometer is all there is.
    pub fn is_magnetometer_only(&self) -> bool {
        let others = [&self.accelerometer, &self.gyroscope];
        self.magnetometer.is_some() && others.iter().all(|stream| stream.is_none())
    }
}
