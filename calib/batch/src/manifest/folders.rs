//! Devices by folder: each sub-folder and each file is one.

use std::path::Path;

use super::device::{Device, DeviceOptions};
use crate::error::Error;
use crate::hash::members;

/// Endings of files that are no recordings.
const OTHER: [&str; 11] = [
    "json", "html", "svg", "png", "md", "toml", "partial", "txt~", "pdf", "py", "sh",
];

/// The devices in a folder, by name.
pub(super) fn devices(folder: &Path) -> Result<Vec<Device>, Error> {
    let all = members(folder).map_err(|source| Error::Io {
        path: folder.to_owned(),
        source,
    })?;
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
            id: without_ending(&name.unwrap_or_default().to_string_lossy()),
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
