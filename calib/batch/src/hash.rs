//! Hashes of texts and of inputs.

use std::fs::File;
use std::io::Read;
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
                Finding::of(Kind::FoldersTooDeep).count("limit", DEEPEST),
            ));
        }
        for member in members(path).map_err(Error::at(path))? {
            add(hash, &member, deeper - 1)?;
        }
        return Ok(());
    }
    if !found.is_file() {
        return Err(refused(path, Finding::of(Kind::NoFileOrFolder)));
    }
    hash.update(found.len().to_le_bytes());
    let mut file = File::open(path).map_err(Error::at(path))?;
    let mut block = vec![0; 1 << 16];
    loop {
        match file.read(&mut block).map_err(Error::at(path))? {
            0 => return Ok(()),
            n => hash.update(&block[..n]),
        }
    }
}

fn refused(path: &Path, found: Finding) -> Error {
    Error::Input(Box::new(found.in_file(shown_path(path))))
}

/// Lists the paths in a folder, sorted by name, without hidden files.
///
/// # Errors
/// The folder or one of its entries cannot be read.
pub fn members(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut members = Vec::new();
    for entry in std::fs::read_dir(folder)? {
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
