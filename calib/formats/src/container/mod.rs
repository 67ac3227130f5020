//! Files by name: a folder, a zip archive that is never unpacked to the disk, or a file of tables.

pub(crate) mod archive;
mod directory;
mod entry;

use findings::{Finding, Findings, Kind};
use std::fs::{File, ReadDir};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use archive::Archive;
use directory::Packed;

use crate::shown::shown;
use crate::store::Store;
use crate::tables::Tabular;
use crate::{Error, Limits};

/// Folders within a folder that are looked into.
const DEPTH: usize = 2;

/// A file in a container.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its name, with `/` between folders.
    pub name: String,
    /// Its size when unpacked, bytes; 0 of a table.
    pub size: u64,
    place: Place,
}

/// Location of an entry's bytes.
#[derive(Clone, Debug)]
enum Place {
    File(PathBuf),
    Packed(Packed),
    Table,
}

/// Files by name, in the order of their names.
#[derive(Clone, Debug)]
pub struct Container {
    entries: Vec<Entry>,
    archive: Option<Archive>,
    /// The format of tables, of which each is an entry, and the file.
    tabular: Option<(&'static Tabular, Store)>,
    limits: Limits,
    /// Warnings about entries that were left out.
    pub warnings: Findings,
}

/// Lists the entries of a folder; the call is made again where a signal comes between.
///
/// # Errors
/// The folder cannot be read.
pub fn read_folder(folder: &Path) -> io::Result<ReadDir> {
    loop {
        match std::fs::read_dir(folder) {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            other => return other,
        }
    }
}

/// Returns true if a file or folder may not be looked into, or has gone: then it holds nothing for us.
fn is_closed_or_gone(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::PermissionDenied | ErrorKind::NotFound
    )
}

/// An error with the name of the file or folder within; that of the folder itself is empty.
fn of_member(name: &str, error: &io::Error) -> Error {
    let reason = match name.trim_end_matches('/') {
        "" => error.to_string(),
        member => format!("{}: {error}", shown(member)),
    };
    Error::Io(io::Error::new(error.kind(), reason))
}

impl Container {
    /// The files in the folder at `path` and in the folders within it.
    ///
    /// # Errors
    /// A folder that cannot be listed, or holds too many files.
    pub fn folder(path: &Path, limits: Limits) -> Result<Self, Error> {
        let mut entries = Vec::new();
        let mut folders = vec![(path.to_owned(), String::new(), 0)];
        while let Some((folder, prefix, depth)) = folders.pop() {
            let items = match read_folder(&folder) {
                Err(error) if depth > 0 && is_closed_or_gone(&error) => continue,
                other => other.map_err(|error| of_member(&prefix, &error))?,
            };
            for item in items {
                let path = item.map_err(|error| of_member(&prefix, &error))?.path();
                let Some(name) = path.file_name() else {
                    continue;
                };
                let name = format!("{prefix}{}", name.to_string_lossy());
                let metadata = match path.metadata() {
                    Ok(metadata) => metadata,
                    Err(error) if error.kind() == ErrorKind::NotFound => continue,
                    Err(error) if is_closed_or_gone(&error) && (depth > 0 || path.is_symlink()) => {
                        continue;
                    }
                    // Of a recording without one of its files nobody would know that something is missing.
                    Err(error) => return Err(of_member(&name, &error)),
                };
                if metadata.is_dir() && depth < DEPTH {
                    folders.push((path, format!("{name}/"), depth + 1));
                    continue;
                }
                // Pipes and devices would be waited for.
                if !metadata.is_file() {
                    continue;
                }
                entries.push(Entry {
                    name,
                    size: metadata.len(),
                    place: Place::File(path),
                });
                if entries.len() > limits.entries {
                    return Err(limits.too_many_entries());
                }
            }
        }
        Ok(Self::new(entries, limits, Findings::new()))
    }

    /// The entries of the zip archive at `path`.
    ///
    /// # Errors
    /// A damaged directory with the byte, encryption, or an archive beyond the limits.
    pub fn zip(path: &Path, limits: Limits) -> Result<Self, Error> {
        Self::of_archive(Store::File(path.to_owned()), limits)
    }

    /// The entries of a zip archive in memory.
    ///
    /// # Errors
    /// As [`Container::zip`].
    pub fn zip_in_memory(bytes: impl Into<Arc<[u8]>>, limits: Limits) -> Result<Self, Error> {
        Self::of_archive(Store::Memory(bytes.into()), limits)
    }

    /// The tables of the file at `path`, texts of comma-separated cells.
    ///
    /// # Errors
    /// A format that this build does not read, damage, or a file beyond the limits.
    pub fn tables(format: &'static Tabular, path: &Path, limits: Limits) -> Result<Self, Error> {
        Self::of_tables(format, Store::File(path.to_owned()), limits)
    }

    /// The tables of a file in memory.
    ///
    /// # Errors
    /// As [`Container::tables`].
    pub fn tables_in_memory(
        format: &'static Tabular,
        bytes: Arc<[u8]>,
        limits: Limits,
    ) -> Result<Self, Error> {
        Self::of_tables(format, Store::Memory(bytes), limits)
    }

    fn of_tables(format: &'static Tabular, store: Store, limits: Limits) -> Result<Self, Error> {
        let listed = format.tables(&store, limits)?;
        let entry = |name: String| Entry {
            name,
            size: 0,
            place: Place::Table,
        };
        let entries = listed.names.into_iter().map(entry).collect();
        Ok(Self {
            tabular: Some((format, store)),
            ..Self::new(entries, limits, listed.warnings)
        })
    }

    fn of_archive(store: Store, limits: Limits) -> Result<Self, Error> {
        let archive = Archive::open(store, limits)?;
        let entry = |(name, packed): &(String, Packed)| Entry {
            name: name.clone(),
            size: packed.size,
            place: Place::Packed(*packed),
        };
        let entries = archive.entries.iter().map(entry).collect();
        let warnings = archive.warnings.clone();
        Ok(Self {
            archive: Some(archive),
            ..Self::new(entries, limits, warnings)
        })
    }

    fn new(mut entries: Vec<Entry>, limits: Limits, warnings: Findings) -> Self {
        entries.sort_by(|a, b| a.name.cmp(&b.name));
        Self {
            entries,
            archive: None,
            tabular: None,
            limits,
            warnings,
        }
    }

    /// The files, in the order of their names.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// True for an archive.
    pub fn is_archive(&self) -> bool {
        self.archive.is_some()
    }

    /// The format of tables that it is.
    pub fn tabular(&self) -> Option<&'static Tabular> {
        self.tabular.as_ref().map(|(format, _)| *format)
    }

    /// The content of an entry. Reading fails where it is damaged.
    ///
    /// # Errors
    /// A file that cannot be opened, or a way of packing that is not known.
    pub fn open(&self, entry: &Entry) -> Result<Box<dyn Read + Send>, Error> {
        match (&entry.place, &self.archive, &self.tabular) {
            (Place::File(path), ..) => Ok(Box::new(File::open(path)?)),
            (Place::Packed(packed), Some(archive), _) => archive.content(&entry.name, packed),
            (Place::Table, _, Some((format, store))) => {
                format.text(store, &entry.name, self.limits)
            }
            _ => {
                let found = Finding::of(Kind::ENTRY_ELSEWHERE);
                Err(Error::refused(found.detail("entry", shown(&entry.name))))
            }
        }
    }

    /// Writes the content of an entry to `out`, on this thread.
    ///
    /// # Errors
    /// As [`Container::open`], damage, and what `out` fails with.
    pub fn write(&self, entry: &Entry, out: &mut dyn Write) -> Result<(), Error> {
        match (&entry.place, &self.tabular) {
            (Place::Table, Some((format, store))) => {
                format.write(store, &entry.name, self.limits, out)
            }
            _ => {
                std::io::copy(&mut self.open(entry)?, out)?;
                Ok(())
            }
        }
    }

    /// The path of an entry that is a file of its own.
    pub fn path<'a>(&self, entry: &'a Entry) -> Option<&'a Path> {
        match &entry.place {
            Place::File(path) => Some(path),
            Place::Packed(_) | Place::Table => None,
        }
    }
}

#[cfg(test)]
mod tests;
