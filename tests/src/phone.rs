//! The phone recordings behind the article's re-examination, where they are at hand.

use std::path::PathBuf;

use calib::Recording;
use calib::recording::ReadOptions;

use crate::needed_data::needed;

/// The folder of the phone recordings; `None`, said aloud, where it is [missing](needed).
pub fn folder() -> Option<PathBuf> {
    needed("phone")
}

/// One recording of the phone, by its path in the folder.
///
/// # Errors
/// What the reader says.
pub fn recording(name: &str) -> Result<Recording, calib::Error> {
    let path = folder().unwrap_or_default().join(name);
    let recording = Recording::read(&path, &ReadOptions::default())?;
    Ok(Recording {
        name: name.into(),
        ..recording
    })
}

/// A number of `golden.json` or another JSON file of the folder, by its JSON pointer.
pub fn number(json: &serde_json::Value, pointer: &str) -> Option<f64> {
    json.pointer(pointer)?.as_f64()
}

/// A JSON file of the folder.
pub fn json(name: &str) -> Option<serde_json::Value> {
    let text = std::fs::read_to_string(folder()?.join(name)).ok()?;
    serde_json::from_str(&text).ok()
}
