//! Hashes of texts and of inputs.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use calib::recording::shown::shown_path;
use findings::{Finding, Kind};
use sha2::{Digest, Sha256};

use crate::error::Error;

/// Depth of folders below an input.
const DEEPEST: usize = 4;

/// SHA-256 in hexadecimal.
pub fn of_text(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}

/// SHA-256 of the files at `paths`: of a folder, of every file in it by name. Names and contents count.
///
/// # Errors
/// What cannot be read.
pub fn of_inputs(paths: &[PathBuf]) -> Result<String, Error> {
    let mut hash = Sha256::new();
    for path in paths {
        add(&mut hash, path, DEEPEST)?;
    }
    Ok(hexadecimal(&hash.finalize()))
}

fn add(hash: &mut Sha256, path: &Path, deeper: usize) -> Result<(), Error> {
    let found = std::fs::metadata(path).map_err(Error::at(path))?;
    hash.update(path.file_name().unwrap_or_default().as_encoded_bytes());
    if found.is_dir() {
        if deeper == 0 {
            return Err(refused(
                path,
                Finding::of(Kind::FOLDERS_TOO_DEEP).count("limit", DEEPEST),
            ));
        }
        for member in members(path).map_err(Error::at(path))? {
            add(hash, &member, deeper - 1)?;
        }
        return Ok(());
    }
    if !found.is_file() {
        return Err(refused(path, Finding::of(Kind::NO_FILE_OR_FOLDER)));
    }
    hash.update(found.len().to_le_bytes());
    let file = File::open(path).map_err(Error::at(path))?;
    feed(hash, file).map_err(Error::at(path))
}

/// All bytes of `reader`.
fn feed(hash: &mut Sha256, mut reader: impl Read) -> std::io::Result<()> {
    let mut block = vec![0; 1 << 16];
    loop {
        match reader.read(&mut block) {
            Ok(0) => return Ok(()),
            Ok(n) => hash.update(&block[..n]),
            // A signal came between.
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

fn refused(path: &Path, found: Finding) -> Error {
    Error::Input(Box::new(found.in_file(shown_path(path))))
}

/// Returns true if a path is a folder; false for one that does not exist, whose reader says so.
///
/// # Errors
/// The system does not tell.
pub fn is_folder(path: &Path) -> Result<bool, Error> {
    match std::fs::metadata(path) {
        Ok(found) => Ok(found.is_dir()),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(Error::at(path)(error)),
    }
}

/// Lists the paths in a folder, sorted by name, without hidden files.
///
/// # Errors
/// The folder or one of its entries cannot be read.
pub fn members(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut members = Vec::new();
    for entry in file_formats::read_folder(folder)? {
        let entry = entry?;
        if !entry.file_name().as_encoded_bytes().starts_with(b".") {
            members.push(entry.path());
        }
    }
    members.sort();
    Ok(members)
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `ab`, with a signal before every byte.
    struct Disturbed(Vec<u8>, bool);

    impl Read for Disturbed {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            self.1 = !self.1;
            match (self.1, self.0.pop()) {
                (true, last) => {
                    self.0.extend(last);
                    Err(ErrorKind::Interrupted.into())
                }
                (false, Some(byte)) => {
                    buffer[0] = byte;
                    Ok(1)
                }
                (false, None) => Ok(0),
            }
        }
    }

    #[test]
    fn a_read_that_a_signal_interrupts_is_made_again() {
        let mut hash = Sha256::new();
        feed(&mut hash, Disturbed(b"ba".to_vec(), false)).unwrap();
        assert_eq!(hexadecimal(&hash.finalize()), of_text("ab"));
    }

    #[cfg(unix)]
    #[test]
    fn what_the_system_does_not_tell_of_is_neither_file_nor_folder() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("devices");
        assert!(!is_folder(&path).unwrap());
        std::os::unix::fs::symlink("devices", &path).unwrap();
        assert!(is_folder(&path).is_err());
    }
}
