//! Folders made for outputs.

use std::path::{Path, PathBuf};

use super::refusal::refused;
use crate::exit::Failure;
use crate::interrupt;

/// The folders that were made for an output. Those that hold nothing in the end are removed.
#[derive(Debug, Default)]
pub struct Folder {
    /// The outermost first.
    made: Vec<PathBuf>,
}

impl Folder {
    /// Makes `path` and what it lies in, as far as it is not there.
    ///
    /// # Errors
    /// Status 6 with the system's reason.
    pub fn make(path: &Path) -> Result<Self, Failure> {
        let missing = |p: &&Path| !p.as_os_str().is_empty() && !p.is_dir();
        let missing: Vec<&Path> = path.ancestors().take_while(missing).collect();
        let mut folder = Self::default();
        for part in missing.into_iter().rev() {
            let mut leftovers = interrupt::hold();
            match std::fs::create_dir(part) {
                Ok(()) => {
                    leftovers.folders.push(part.to_owned());
                    folder.made.push(part.to_owned());
                }
                // Another run was faster.
                Err(_) if part.is_dir() => {}
                Err(error) => {
                    drop(leftovers);
                    let why =
                        format!("cannot be made: {error}; choose a folder that can be written to");
                    return Err(refused(part, &why));
                }
            }
        }
        Ok(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let mut leftovers = interrupt::hold();
        for path in self.made.iter().rev() {
            // It stays where something is in it.
            let _ = std::fs::remove_dir(path);
            leftovers.folders.retain(|other| other != path);
        }
    }
}
