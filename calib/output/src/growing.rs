//! Files that grow while something is recorded.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::claim::refuse_input;
use crate::error::{Error, Reason};
use crate::leftovers::leftovers;

/// A file to which whole records are appended as they come, so that a process that is killed loses none of them.
#[derive(Debug)]
pub struct Growing {
    path: PathBuf,
    file: File,
    /// Bytes of whole records; `None` for a pipe or a device.
    whole: Option<u64>,
    /// It was begun here and has no record yet, so that it goes where none comes.
    bare: bool,
}

impl Growing {
    /// Begins a file that is not there, and follows no link.
    ///
    /// # Errors
    /// A file or a link that is there; the system's reason.
    pub fn begin(path: &Path) -> Result<Self, Error> {
        let mut leftovers = leftovers();
        let file = OpenOptions::new().append(true).create_new(true).open(path);
        let file = file.map_err(|error| Reason::System(error).of(path))?;
        leftovers.files.push(path.to_owned());
        Ok(Self {
            path: path.to_owned(),
            file,
            whole: Some(0),
            bare: true,
        })
    }

    /// Goes on with the file that a person calls `path`, or begins it; it may be a pipe or a device, but none of `inputs`.
    ///
    /// # Errors
    /// An input, a folder, a link to nothing; the system's reason.
    pub fn append_to(path: &Path, inputs: &[&Path]) -> Result<Self, Error> {
        let target = refuse_input(path, inputs)?;
        let Ok(found) = std::fs::metadata(&target) else {
            return match target.is_symlink() {
                true => {
                    let aim = std::fs::read_link(&target).unwrap_or_default();
                    Err(Reason::Dangling(aim).of(path))
                }
                false => Self::begin(&target),
            };
        };
        if found.is_dir() {
            return Err(Reason::NoFile.of(path));
        }
        let file = OpenOptions::new().append(true).open(&target);
        let file = file.map_err(|error| Reason::System(error).of(path))?;
        Ok(Self {
            path: path.to_owned(),
            file,
            whole: found.is_file().then_some(found.len()),
            bare: false,
        })
    }

    /// Appends a record. One that does not fit any more is taken off again.
    ///
    /// # Errors
    /// The system's reason.
    pub fn append(&mut self, record: &[u8]) -> Result<(), Error> {
        match self.file.write_all(record) {
            Ok(()) => {
                self.whole = self.whole.map(|bytes| bytes + record.len() as u64);
                if std::mem::take(&mut self.bare) {
                    leftovers().files.retain(|path| *path != self.path);
                }
                Ok(())
            }
            Err(error) => {
                if let Some(bytes) = self.whole {
                    let _ = self.file.set_len(bytes);
                }
                Err(Reason::System(error).of(&self.path))
            }
        }
    }
}

impl Drop for Growing {
    fn drop(&mut self) {
        if self.bare {
            let mut leftovers = leftovers();
            let _ = std::fs::remove_file(&self.path);
            leftovers.files.retain(|path| *path != self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_kept_and_a_file_without_one_goes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("events");
        drop(Growing::append_to(&path, &[]).unwrap());
        assert!(!path.exists());
        for _ in 0..2 {
            let mut file = Growing::append_to(&path, &[]).unwrap();
            file.append(b"one\n").unwrap();
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"one\none\n");
        assert!(Growing::begin(&path).is_err());
        let refused = Growing::append_to(&path, &[&path]).unwrap_err();
        assert!(matches!(refused.reason, Reason::Input(_)));
    }
}
