//! Folders made for outputs.

use std::path::{Path, PathBuf};

use crate::error::{Error, Reason};
use crate::leftovers::leftovers;

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
    /// The system's reason.
    pub fn make(path: &Path) -> Result<Self, Error> {
        let missing = |p: &&Path| !p.as_os_str().is_empty() && !p.is_dir();
        let missing: Vec<&Path> = path.ancestors().take_while(missing).collect();
        let mut folder = Self::default();
        for part in missing.into_iter().rev() {
            let mut leftovers = leftovers();
            match std::fs::create_dir(part) {
                Ok(()) => {
                    leftovers.folders.push(part.to_owned());
                    folder.made.push(part.to_owned());
                }
                // Another run was faster.
                Err(_) if part.is_dir() => {}
                Err(error) => {
                    drop(leftovers);
                    return Err(Reason::Folder(error).of(part));
                }
            }
        }
        Ok(folder)
    }

    /// Makes `path`, the last `own` parts of which we name ourselves: nobody has put a link in their place.
    ///
    /// # Errors
    /// A link there; the system's reason.
    pub fn make_own(path: &Path, own: usize) -> Result<Self, Error> {
        let folder = Self::make(path)?;
        match path.ancestors().take(own).find(|part| part.is_symlink()) {
            Some(link) => Err(Reason::Linked.of(link)),
            None => Ok(folder),
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let mut leftovers = leftovers();
        for path in self.made.iter().rev() {
            // It stays where something is in it, and is tried again where that is a leftover of another thread.
            let _ = std::fs::remove_dir(path);
            if !leftovers.files.iter().any(|file| file.starts_with(path)) {
                leftovers.folders.retain(|other| other != path);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Growing;

    #[test]
    fn a_folder_with_an_empty_file_of_another_thread_goes_with_it() {
        let outer = tempfile::tempdir().unwrap();
        let path = outer.path().join("session");
        let folder = Folder::make(&path).unwrap();
        let held = Growing::begin(&path.join("lines.txt")).unwrap();
        drop(folder);
        assert!(path.is_dir());
        // No other: tests share the leftovers of the process.
        let is_left = leftovers().folders.contains(&path);
        drop(held);
        assert!(is_left);
    }
}
