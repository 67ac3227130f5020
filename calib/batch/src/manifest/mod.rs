//! Manifest of a batch: the devices, their input files and their options.

mod device;
mod folders;
mod lines;

use std::path::PathBuf;

use calib::recording::shown::{shown, shown_path};
use findings::{Finding, Kind};
use serde::{Deserialize, Serialize};

pub use self::device::{Device, DeviceOptions};
use crate::error::Error;
use crate::hash;

/// All devices, in order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// In the order of the file, or by name.
    pub devices: Vec<Device>,
}

impl Manifest {
    /// Reads the devices from folders and from manifest files (CSV, TOML or JSON lines).
    ///
    /// Each sub-folder and each file of a folder is one device.
    ///
    /// # Errors
    /// [`Error::Manifest`] with the place for an unknown column, a duplicate name, or a manifest without devices;
    /// [`Error::Io`] for a path that cannot be read.
    pub fn read(paths: &[PathBuf]) -> Result<Self, Error> {
        let mut devices = Vec::new();
        for path in paths {
            devices.extend(match hash::is_folder(path)? {
                true => folders::devices(path)?,
                false => lines::devices(path)?,
            });
        }
        let mut names: Vec<&str> = devices.iter().map(|d: &Device| d.id.as_str()).collect();
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let found = Finding::of(Kind::DEVICE_TWICE).detail("device", shown(twice[0]));
            return Err(Error::Manifest(found.into()));
        }
        if devices.is_empty() {
            let names: Vec<_> = paths.iter().map(|p| shown_path(p)).collect();
            let found = Finding::of(Kind::NO_DEVICE).in_file(names.join(", "));
            return Err(Error::Manifest(found.into()));
        }
        Ok(Self { devices })
    }

    /// SHA-256 of the devices and of `options`: parts of one run have it in common.
    pub fn sha256(&self, options: &str) -> String {
        let devices = serde_json::to_string(&self.devices).unwrap_or_default();
        hash::of_text(&format!("{devices}\n{options}"))
    }
}
