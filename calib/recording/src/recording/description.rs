//! Where the samples of a recording come from, for `info`.

use sensor::Sensor;

/// What decided the unit of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitBy {
    /// An option.
    Option,
    /// The file or its format.
    File,
    /// The samples.
    Data,
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
    /// What decided it.
    pub unit_by: UnitBy,
    /// The sign was turned to +g on the axis that points up.
    pub turned: bool,
}

/// Format and sensors of a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// The name of the format.
    pub format: &'static str,
    /// The sensors.
    pub sensors: Vec<Described>,
}
