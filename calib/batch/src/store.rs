//! The output folder: a folder per device that says by hash whether it is complete.
//!
//! ```text
//! OUT/devices/ID/cal.json      the calibration
//! OUT/devices/ID/record.json   written last; names the hash of cal.json and of what both were made from
//! ```
//! Both are complete beside their place before either is put there. Between the two the old record names another hash than that
//! of the new calibration, so that the device counts as incomplete. They are not synced one by one, which costs 8 ms a file: after
//! a power failure a file may be short, and its hash then says so. The part file of a shard is synced.

use std::path::{Path, PathBuf};

use output::{Existing, Folder, Output};

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

    /// True where an earlier run has left a record of a device.
    pub(crate) fn holds(&self, id: &str) -> bool {
        self.device(id).join("record.json").exists()
    }

    /// Writes what was computed of a device in place of what was there.
    pub(crate) fn write(&self, computed: &Computed) -> Result<(), Error> {
        let folder = self.device(&computed.record.id);
        let made = Folder::make_own(&folder, 2)?;
        let claim = |name: &str| {
            let output = Output::claim_in(&folder, name, Existing::Replace, &[])?;
            Ok::<_, Error>(output.unsynced())
        };
        let cal = match &computed.calibration {
            Some(text) => Some(claim("cal.json")?.fill(|out| out.write_all(text.as_bytes()))?),
            None => None,
        };
        let text = serde_json::to_string(&computed.record).unwrap_or_default() + "\n";
        let record = claim("record.json")?.fill(|out| out.write_all(text.as_bytes()))?;
        match cal {
            Some(cal) => cal.publish()?,
            None => remove(&folder.join("cal.json"))?,
        }
        record.publish()?;
        drop(made);
        Ok(())
    }
}

/// Removes a calibration that is none any more.
fn remove(path: &Path) -> Result<(), Error> {
    match std::fs::remove_file(path) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => Err(Error::Output {
            path: path.to_owned(),
            source,
        }),
        _ => Ok(()),
    }
}
