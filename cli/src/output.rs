//! Result files: written whole or not at all.
//!
//! An [`Output`] is claimed before anything is computed, so that a folder that cannot be written, a
//! file in the way or a second run are found at once. It is written to `.NAME.partial` beside the
//! target, synced and renamed. The partial file is locked while its owner lives: a killed run leaves
//! it unlocked, and the next one takes it over.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};

use crate::exit::{Failure, OUTPUT, USAGE};
use crate::interrupt;

/// A claim on a file to be written.
#[derive(Debug)]
pub struct Output {
    target: PathBuf,
    partial: PathBuf,
    file: File,
}

impl Output {
    /// Claims `path`; `inputs` are files that it must not be.
    ///
    /// # Errors
    /// Status 2 where the path is an input or another output of this run; status 6 where it exists (without `force`), is no
    /// regular file, lies in a folder that cannot be written, or is claimed by another run.
    pub fn claim(path: &Path, force: bool, inputs: &[&Path]) -> Result<Self, Failure> {
        let target = resolve(path);
        if let Some(input) = inputs.iter().find(|input| same(input, &target)) {
            return Err(Failure::new(
                USAGE,
                format!(
                    "-o {}: is the input {}; choose another name",
                    path.display(),
                    input.display()
                ),
            ));
        }
        match std::fs::metadata(&target) {
            Ok(found) if !found.is_file() => {
                return Err(refused(path, "is no regular file; choose another name"));
            }
            Ok(_) if !force => {
                return Err(refused(path, "exists already; add --force to replace it"));
            }
            _ => {}
        }
        let partial = partial_name(&target)
            .ok_or_else(|| refused(path, "is no file name; name a file to write"))?;
        let mut file = OpenOptions::new()
            .create(true)
            .truncate(false)
            .read(true)
            .write(true)
            .open(&partial)
            .map_err(|e| refused(path, &format!("cannot be written: {e}")))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let mut holder = String::new();
                let _ = file.read_to_string(&mut holder);
                if holder.trim() == std::process::id().to_string() {
                    let why = format!(
                        "{}: given for two outputs; choose another name",
                        path.display()
                    );
                    return Err(Failure::new(USAGE, why));
                }
                return Err(refused(
                    path,
                    &format!(
                        "is being written by another run (process {})",
                        holder.trim()
                    ),
                ));
            }
            Err(TryLockError::Error(e)) => {
                return Err(refused(path, &format!("cannot be locked: {e}")));
            }
        }
        interrupt::remember(partial.clone());
        let claimed = file
            .set_len(0)
            .and_then(|()| write!(file, "{}", std::process::id()));
        claimed.map_err(|e| refused(path, &format!("cannot be written: {e}")))?;
        Ok(Self {
            target,
            partial,
            file,
        })
    }

    /// Puts `contents` in place of the target.
    ///
    /// # Errors
    /// Status 6 with the system's reason; the target is as it was.
    pub fn write(mut self, contents: &[u8]) -> Result<(), Failure> {
        let written = self
            .file
            .set_len(0)
            .and_then(|()| self.file.rewind())
            .and_then(|()| self.file.write_all(contents))
            .and_then(|()| self.file.sync_all())
            .and_then(|()| std::fs::rename(&self.partial, &self.target));
        written.map_err(|e| refused(&self.target, &format!("cannot be written: {e}")))
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        // After a successful rename there is nothing left to remove.
        let _ = std::fs::remove_file(&self.partial);
        interrupt::forget(&self.partial);
    }
}

fn refused(path: &Path, why: &str) -> Failure {
    Failure::new(OUTPUT, format!("{}: {why}", path.display()))
}

/// The file that the path stands for, links followed.
fn resolve(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

fn partial_name(target: &Path) -> Option<PathBuf> {
    let mut name = std::ffi::OsString::from(".");
    name.push(target.file_name()?);
    name.push(".partial");
    Some(target.with_file_name(name))
}

/// Whether two paths are one file, through links of either kind; a folder holds its recordings.
fn same(input: &Path, target: &Path) -> bool {
    let members = ["acc.csv", "gyro.csv"].map(|name| input.join(name));
    std::iter::once(input.to_owned())
        .chain(members)
        .any(|file| same_file::is_same_file(file, target).unwrap_or(false))
}
