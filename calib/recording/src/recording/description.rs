//! Format, columns and units of a recording, for `info`.

use sensor::Sensor;
use serde::{Deserialize, Serialize};

use crate::shown::significant;

/// Source of a sensor's unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitBy {
    /// An option.
    Option,
    /// The file or its format.
    File,
    /// The samples.
    Data,
    /// Nothing: it is the SI unit, unless the readings are too large for it.
    Nothing,
}

impl UnitBy {
    /// Returns its name: `option`, `file`, `samples` or `nothing`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Option => "option",
            Self::File => "file",
            Self::Data => "samples",
            Self::Nothing => "nothing",
        }
    }
}

/// One sensor of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Described {
    /// The sensor.
    pub sensor: Sensor,
    /// The file, entry, topic or variable.
    pub source: String,
    /// Role and name of every column.
    pub columns: Vec<(&'static str, String)>,
    /// Names of columns that are not read.
    pub unused: Vec<String>,
    /// The unit of the file.
    pub unit: &'static str,
    /// Source of the unit.
    pub unit_by: UnitBy,
    /// The sign was turned to +g on the axis that points up.
    pub turned: bool,
    /// The axes that options read with the other sign, as `gx`.
    pub flipped: Vec<&'static str>,
}

impl Described {
    /// Returns the names of the columns of the axes x, y, z.
    pub fn axes(&self) -> Vec<String> {
        let axes = self.columns.iter().filter(|(role, _)| *role != "t");
        axes.map(|(_, column)| column.clone()).collect()
    }

    /// Returns the stamps by a clock that counts so often in a second, as the option of the columns takes them: `t=stamp/1024`.
    pub fn by_clock(&self, per_second: f64) -> String {
        let own = self.columns.iter().find(|(role, _)| *role == "t");
        let name = own.map_or("1", |(_, name)| name);
        format!("t={name}/{}", significant(per_second, 6))
    }
}

/// Format and sensors of a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// The name of the format.
    pub format: &'static str,
    /// The sensors.
    pub sensors: Vec<Described>,
    /// Corrections that systems had applied to the readings before they were recorded.
    pub applied_before: Vec<AppliedBefore>,
}

impl Description {
    /// Returns where a sensor comes from.
    pub fn of(&self, sensor: Sensor) -> Option<&Described> {
        self.sensors.iter().find(|own| own.sensor == sensor)
    }
}

/// A correction that a system had applied to the readings of a sensor before they were recorded.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AppliedBefore {
    /// `accelerometer`, `gyroscope` or `magnetometer`.
    pub sensor: String,
    /// The system: `px4`, `ardupilot`, `ios`, or [`AppliedBefore::UNKNOWN`].
    pub by: String,
    /// Taken off again by the reader: the readings are those of the sensor.
    #[serde(default)]
    pub undone: bool,
}

impl AppliedBefore {
    /// A system that the readings show and nobody names.
    pub const UNKNOWN: &'static str = "unknown";

    /// Builds a correction of a sensor by `system` that is still in its readings.
    pub fn by(system: &str, sensor: Sensor) -> Self {
        Self {
            sensor: sensor.name().into(),
            by: system.into(),
            undone: false,
        }
    }
}
