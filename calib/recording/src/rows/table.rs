//! What one text holds, in its own units.

use sensor::Sensor;

use crate::Error;
use crate::clock::Clock;
use crate::recording::options::Role;
use crate::recording::samples::Samples;
use crate::source::place::in_file;
use crate::units::Stated;

/// What one text held, in its own units.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// The file, for messages.
    pub name: String,
    /// Accelerometer.
    pub accel: Samples,
    /// Gravity, until it is added to what the accelerometer's columns hold.
    pub gravity: Samples,
    /// Gyroscope.
    pub gyro: Samples,
    /// Magnetometer.
    pub magnetometer: Samples,
    /// Stamps of temperature readings.
    pub temperature_t: Vec<f64>,
    /// Temperature readings.
    pub temperature: Vec<f64>,
    /// Units in the header.
    pub stated: Stated,
    /// What the header states of the accelerometer and of the gyroscope, where that is no known unit.
    pub strange: [Option<String>; 2],
    /// The name of the time column is `t`: seconds, by contract.
    pub plain_time: bool,
    /// Names of columns that no sensor is read from.
    pub unused: Vec<String>,
    /// Names of those of them whose numbers change.
    pub unclear: Vec<String>,
    /// Names of all columns.
    pub names: Vec<String>,
    /// What is what was told by them, not by a format or the user.
    pub by_names: bool,
    /// Which column each role is read from, by name or number.
    pub roles: Vec<(Role, String)>,
    /// It has a time column.
    pub has_time: bool,
    /// Its clock.
    pub clock: Clock,
    /// The accelerometer reads -1 g on the axis that points up.
    pub negated: bool,
    /// The system that had corrected the readings before.
    pub corrected_by: Option<&'static str>,
    /// What was noticed.
    pub warnings: Vec<String>,
}

impl Table {
    /// True for readings of an accelerometer or a gyroscope.
    pub fn has_sensor(&self) -> bool {
        !self.accel.t.is_empty() || !self.gyro.t.is_empty()
    }

    /// The stamps of everything in it.
    pub fn stamps_mut(&mut self) -> [&mut Vec<f64>; 4] {
        [
            &mut self.accel.t,
            &mut self.gyro.t,
            &mut self.magnetometer.t,
            &mut self.temperature_t,
        ]
    }

    /// Leaves out what a file of one sensor holds of the other.
    pub fn keep_only(&mut self, sensor: Sensor) -> Result<(), Error> {
        let (kept, other, role) = match sensor {
            Sensor::Accelerometer => (&self.accel, &mut self.gyro, "ax, ay, az"),
            Sensor::Gyroscope => (&self.gyro, &mut self.accel, "gx, gy, gz"),
            // A magnetometer's file is read with all that it holds.
            Sensor::Magnetometer => return Ok(()),
        };
        if kept.t.is_empty() {
            return Err(in_file(
                &self.name,
                format!("no columns {role}; are the two files swapped?"),
            ));
        }
        *other = Samples::default();
        Ok(())
    }
}
