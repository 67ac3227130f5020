//! The magnetic field in which a magnetometer was calibrated.

use serde::{Deserialize, Serialize};

/// The field of the place, that of the last recording where there are several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MagneticField {
    /// Unit of the field: `uT`, or `reading` where neither the file states the unit of the magnetometer nor the strength was given.
    pub unit: String,
    /// Unit of the magnetometer's readings, where it is another: `reading` where the strength was given and the file states none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reading_unit: Option<String>,
    /// True if the strength was given. Otherwise the scale of the magnetometer is free: its `T` has determinant 1, and the
    /// strength is that of the field in units of this sensor.
    pub strength_given: bool,
    /// Standard deviation per axis by which the field differs from one static interval to the next, beyond the noise.
    pub unevenness: f64,
    /// The last recording's field.
    #[serde(flatten)]
    pub last: RecordingField,
    /// The field of every recording, where there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<RecordingField>,
}

impl MagneticField {
    /// Returns the unit of the magnetometer's readings.
    pub fn unit_of_readings(&self) -> &str {
        self.reading_unit.as_deref().unwrap_or(&self.unit)
    }
}

/// The field of one recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingField {
    /// The recording, as the user named it.
    pub recording: String,
    /// Strength.
    pub strength: f64,
    /// Standard error; `None` where it was given.
    pub strength_std: Option<f64>,
    /// Angle below the horizontal, degrees.
    pub inclination: f64,
    /// Standard error, degrees.
    pub inclination_std: f64,
}
