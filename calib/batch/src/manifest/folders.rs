//! Devices by folder: each sub-folder and each file is one.

use std::path::Path;

use super::device::{Device, DeviceOptions, spelled};
use crate::error::Error;
use crate::hash::members;

/// Endings of files that are no recordings.
const OTHER: [&str; 11] = [
    "json", "html", "svg", "png", "md", "toml", "partial", "txt~", "pdf", "py", "sh",
];

/// The devices in a folder, by name.
pub(super) fn devices(folder: &Path) -> Result<Vec<Device>, Error> {
    let all = members(folder).map_err(Error::at(folder))?;
    let recorded = |path: &std::path::PathBuf| {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        path.is_dir() || !ending.is_some_and(|e| OTHER.contains(&e.as_str()))
    };
    let device = |path: std::path::PathBuf| {
        let name = match path.is_dir() {
            true => path.file_name(),
            false => path.file_stem(),
        };
        Device {
            id: without_ending(&spelled(name.unwrap_or_default())),
            inputs: vec![path],
            lot: None,
            station: None,
            time: None,
            options: DeviceOptions::default(),
        }
    };
    Ok(all.into_iter().filter(recorded).map(device).collect())
}

/// `a` of `a.csv`, where that is what is left of `a.csv.gz`.
fn without_ending(name: &str) -> String {
    let inner = name.strip_suffix(".csv").or(name.strip_suffix(".txt"));
    inner.unwrap_or(name).to_owned()
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    use crate::Manifest;

    #[test]
    fn names_that_are_not_utf_8_are_devices_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        for name in [&b"caf\xe9.csv"[..], b"caf\xe8.csv", "café.csv".as_bytes()] {
            std::fs::write(folder.path().join(OsStr::from_bytes(name)), "t,ax\n").unwrap();
        }
        let manifest = Manifest::read(&[folder.path().to_owned()]).unwrap();
        let mut ids: Vec<&str> = manifest.devices.iter().map(|d| d.id.as_str()).collect();
        ids.sort_unstable();
        assert_eq!(ids, ["caf\\xe8", "caf\\xe9", "café"]);
        // The devices are in the sum that parts of one run have in common.
        let fewer = Manifest {
            devices: manifest.devices[1..].to_vec(),
        };
        assert_ne!(manifest.sha256(""), fewer.sha256(""));
    }
}
