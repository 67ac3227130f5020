//! Which devices there are, what is read for each and how.

mod folders;
mod lines;

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::hash;

/// How one device is calibrated, where that differs from the others.
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
}

/// One device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Device {
    /// Its name, once in a manifest.
    pub id: String,
    /// Its recordings.
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

/// All devices, in order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// In the order of the file, or by name.
    pub devices: Vec<Device>,
}

impl Manifest {
    /// Of folders, whose sub-folders and files are a device each, and of manifest files (CSV, TOML or JSON lines).
    ///
    /// # Errors
    /// [`Error::Manifest`] with the place for an unknown column, a name that is there twice, nothing at all;
    /// [`Error::Io`] for what cannot be read.
    pub fn read(paths: &[PathBuf]) -> Result<Self, Error> {
        let mut devices = Vec::new();
        for path in paths {
            devices.extend(match path.is_dir() {
                true => folders::devices(path)?,
                false => lines::devices(path)?,
            });
        }
        let mut names: Vec<&str> = devices.iter().map(|d: &Device| d.id.as_str()).collect();
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Error::Manifest(format!(
                "the device {} is there twice; give each an id of its own in a manifest",
                twice[0]
            )));
        }
        if devices.is_empty() {
            let names: Vec<_> = paths.iter().map(|p| p.display().to_string()).collect();
            return Err(Error::Manifest(format!(
                "{}: no device in it; name a folder with a folder or a file for each, or a manifest",
                names.join(", ")
            )));
        }
        Ok(Self { devices })
    }

    /// SHA-256 of the devices and of `options`: parts of one run have it in common.
    pub fn sha256(&self, options: &str) -> String {
        let devices = serde_json::to_string(&self.devices).unwrap_or_default();
        hash::of_text(&format!("{devices}\n{options}"))
    }
}

/// The `k`-th of `n` parts of the work, `k` from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// From 1.
    pub k: usize,
    /// Of how many.
    pub n: usize,
}

impl Default for Shard {
    fn default() -> Self {
        Self { k: 1, n: 1 }
    }
}

impl Shard {
    /// Whether the device at this place of the manifest is in it. Neighbours go to different shards, so that long and short
    /// recordings spread.
    pub fn has(self, index: usize) -> bool {
        index % self.n == self.k - 1
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text
            .split_once('/')
            .and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((k, n)) if (1..=n).contains(&k) => Ok(Self { k, n }),
            _ => Err(format!("`{text}`: K/N with K from 1 to N expected, as 3/8")),
        }
    }
}
