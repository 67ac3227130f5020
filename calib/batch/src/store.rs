//! The output folder: a folder per device that says by hash whether it is complete.
//!
//! ```text
//! OUT/devices/ID/cal.json      the calibration
//! OUT/devices/ID/record.json   written last; names the hash of cal.json and of what both were made from
//! ```
//! Both are written beside their place and renamed. They are not synced one by one: after a power failure a file may be
//! short, and its hash then says so. The part file of a shard is synced.

use std::io::Error as IoError;
use std::path::{Path, PathBuf};

use crate::device::Computed;
use crate::error::Error;
use crate::hash;
use crate::record::Record;

/// The output folder of a batch.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
}

impl Store {
    /// At `folder`, which need not be there yet.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: folder.into(),
        }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The folder of a device; what a file system may refuse or obey in its name is written as `%XX`.
    pub fn device(&self, id: &str) -> PathBuf {
        let mut name = String::new();
        for byte in id.bytes() {
            match byte {
                b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' => {
                    name.push(char::from(byte))
                }
                b'.' if !name.is_empty() => name.push('.'),
                other => name.push_str(&format!("%{other:02X}")),
            }
        }
        if name.len() > 200 {
            name = format!("{}-{}", &name[..120], hash::of_text(id));
        }
        self.folder.join("devices").join(name)
    }

    /// The record of a device that is complete and made from the same.
    pub(crate) fn complete(&self, id: &str, index: usize, key: &str) -> Option<Record> {
        let folder = self.device(id);
        let text = std::fs::read_to_string(folder.join("record.json")).ok()?;
        let mut record: Record = serde_json::from_str(&text).ok()?;
        if record.key != key || record.id != id {
            return None;
        }
        if let Some(expected) = &record.cal_sha256 {
            let found = std::fs::read_to_string(folder.join("cal.json")).ok()?;
            if &hash::of_text(&found) != expected {
                return None;
            }
        }
        // Its place may be another in a manifest that has grown.
        record.index = index;
        Some(record)
    }

    /// Writes what was computed of a device; what was there before goes first.
    pub(crate) fn write(&self, computed: &Computed) -> Result<(), Error> {
        let folder = self.device(&computed.record.id);
        let output = |path: &Path| {
            let path = path.to_owned();
            move |source: IoError| Error::Output { path, source }
        };
        std::fs::create_dir_all(&folder).map_err(output(&folder))?;
        let (cal, record) = (folder.join("cal.json"), folder.join("record.json"));
        for old in [&record, &cal] {
            match std::fs::remove_file(old) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(output(old)(error));
                }
                _ => {}
            }
        }
        if let Some(text) = &computed.calibration {
            replace(&cal, text).map_err(output(&cal))?;
        }
        let text = serde_json::to_string(&computed.record).unwrap_or_default() + "\n";
        replace(&record, &text).map_err(output(&record))
    }
}

/// Writes a file beside its place and renames it; what a killed run left of it is overwritten.
fn replace(path: &Path, text: &str) -> Result<(), IoError> {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.partial", std::process::id()));
    let partial = path.with_file_name(name);
    std::fs::write(&partial, text)?;
    std::fs::rename(&partial, path)
}
