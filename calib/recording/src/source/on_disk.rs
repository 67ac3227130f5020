//! A file on the disk: whether it changed while it was read, and what is there instead of one that is not.

use std::fs::Metadata;
use std::io;
use std::path::{Path, PathBuf};

use findings::{Finding, Kind};

use super::place::in_file;
use crate::Error;
use crate::shown::{shown, shown_path};

/// A file's size and time of change, to be compared when it has been read.
#[derive(Debug)]
pub(crate) struct Unchanged {
    path: PathBuf,
    size: u64,
    modified: Option<std::time::SystemTime>,
}

impl Unchanged {
    /// The file as it is now.
    pub(crate) fn new(path: &Path, metadata: &Metadata) -> Self {
        Self {
            path: path.to_owned(),
            size: metadata.len(),
            modified: metadata.modified().ok(),
        }
    }

    /// Its size when it was opened, bytes.
    pub(crate) fn size(&self) -> u64 {
        self.size
    }

    /// Refuses a file that changed while it was read.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let now = std::fs::metadata(&self.path).map_err(|error| explained(&self.path, error))?;
        if now.len() == self.size && now.modified().ok() == self.modified {
            return Ok(());
        }
        Err(in_file(
            &shown_path(&self.path),
            Finding::of(Kind::FILE_CHANGED),
        ))
    }
}

/// The system's error, and what is there instead of a file that is not.
pub(crate) fn explained(path: &Path, error: io::Error) -> Error {
    let source = if error.kind() == io::ErrorKind::NotFound {
        let kind = match path.is_symlink() {
            true => Kind::LINK_TO_NOTHING,
            false => Kind::FILE_MISSING,
        };
        let mut found = Finding::of(kind).detail("reason", error.to_string());
        if path.is_relative()
            && let Ok(here) = std::env::current_dir()
        {
            found = found.detail("folder", shown_path(&here));
        }
        if let (Kind::FILE_MISSING, Some(neighbour)) = (kind, nearest(path)) {
            found = found.detail("nearest", shown(&neighbour));
        }
        io::Error::new(error.kind(), found)
    } else {
        error
    };
    Error::Io {
        path: path.to_owned(),
        source,
    }
}

/// The file beside `path` with the most similar name.
fn nearest(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_string_lossy().into_owned();
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let names = std::fs::read_dir(folder).ok()?.take(10_000).flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let likeness = |name: &String| strsim::jaro_winkler(&wanted, name);
    names
        .max_by(|a, b| likeness(a).total_cmp(&likeness(b)))
        .filter(|name| likeness(name) > 0.8)
}
