//! Partial files and empty folders to remove if the process ends now.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Partial files and empty folders of this process.
#[derive(Debug)]
pub struct Leftovers {
    pub(crate) files: Vec<PathBuf>,
    /// Each after the one it lies in.
    pub(crate) folders: Vec<PathBuf>,
}

static LEFTOVERS: Mutex<Leftovers> = Mutex::new(Leftovers {
    files: Vec::new(),
    folders: Vec::new(),
});

/// The leftovers. While they are held no file is made or renamed, so that what ends the process holds them, removes them
/// and never gives them back.
pub fn leftovers() -> MutexGuard<'static, Leftovers> {
    LEFTOVERS.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Leftovers {
    /// Removes the files, and the folders as far as they are empty then.
    pub fn remove(&mut self) {
        for path in self.files.drain(..) {
            let _ = std::fs::remove_file(path);
        }
        for path in self.folders.drain(..).rev() {
            let _ = std::fs::remove_dir(path);
        }
    }
}
