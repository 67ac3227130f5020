//! A device of a manifest.

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::path::PathBuf;

use serde::{Deserialize, Serialize, Serializer};

/// Calibration options of one device that replace those of the batch.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DeviceOptions {
    /// Local gravity, m/s².
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<f64>,
    /// Latitude, °.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude: Option<f64>,
    /// `stepwise` or `joint`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// Effects to fit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effects: Option<Vec<String>>,
    /// The detector's multiplier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub multiplier: Option<f64>,
    /// Shortest static interval, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min_static: Option<f64>,
    /// Sampling rate, Hz, instead of the stamps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
    /// Unit of the accelerometer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accel_unit: Option<String>,
    /// Unit of the gyroscope.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gyro_unit: Option<String>,
    /// Unit of the magnetometer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mag_unit: Option<String>,
}

/// One device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Device {
    /// Its name, once in a manifest.
    pub id: String,
    /// Its recordings.
    #[serde(serialize_with = "spelled_paths")]
    pub inputs: Vec<PathBuf>,
    /// Lot.
    pub lot: Option<String>,
    /// Station.
    pub station: Option<String>,
    /// Time: a number or ISO 8601.
    pub time: Option<String>,
    /// Its own options.
    pub options: DeviceOptions,
}

/// A name of a file in letters, bytes that are none of UTF-8 as `\xe9`: different names stay different.
pub(super) fn spelled(name: &OsStr) -> String {
    let mut text = String::new();
    for chunk in name.as_encoded_bytes().utf8_chunks() {
        text.push_str(chunk.valid());
        for byte in chunk.invalid() {
            let _ = write!(text, "\\x{byte:02x}");
        }
    }
    text
}

fn spelled_paths<S: Serializer>(paths: &[PathBuf], to: S) -> Result<S::Ok, S::Error> {
    to.collect_seq(paths.iter().map(|path| spelled(path.as_os_str())))
}
