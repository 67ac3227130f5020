//! Files by name: a folder, or a zip archive that is never unpacked to the disk.

mod directory;
mod entry;

use std::fs::File;
use std::io::{Cursor, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::{Error, Limits};
use directory::directory;
use entry::unpacked;

/// Folders within a folder that are looked into.
const DEPTH: usize = 2;

/// A file in a container.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its name, with `/` between folders.
    pub name: String,
    /// Its size when unpacked, bytes.
    pub size: u64,
    place: Place,
}

/// Where an entry's bytes are.
#[derive(Clone, Debug)]
enum Place {
    File(PathBuf),
    Packed(directory::Packed),
}

/// Where an archive's bytes are.
#[derive(Clone, Debug)]
enum Archive {
    File(PathBuf),
    Memory(Arc<[u8]>),
}

trait Bytes: Read + Seek + Send {}
impl<T: Read + Seek + Send> Bytes for T {}

impl Archive {
    fn open(&self) -> Result<Box<dyn Bytes>, Error> {
        Ok(match self {
            Self::File(path) => Box::new(File::open(path)?),
            Self::Memory(bytes) => Box::new(Cursor::new(bytes.clone())),
        })
    }
}

/// Files by name, in the order of their names.
#[derive(Clone, Debug)]
pub struct Container {
    entries: Vec<Entry>,
    archive: Option<Archive>,
    limits: Limits,
    /// What was left out, in words.
    pub warnings: Vec<String>,
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
            let items = match std::fs::read_dir(&folder) {
                // A folder within that may not be looked into holds nothing for us.
                Err(_) if depth > 0 => continue,
                other => other?,
            };
            for item in items {
                let path = item?.path();
                let Some(name) = path.file_name() else {
                    continue;
                };
                let name = format!("{prefix}{}", name.to_string_lossy());
                let Ok(metadata) = path.metadata() else {
                    continue;
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
                    return Err(too_many(limits));
                }
            }
        }
        Ok(Self::new(entries, None, limits, Vec::new()))
    }

    /// The entries of the zip archive at `path`.
    ///
    /// # Errors
    /// A damaged directory with the byte, encryption, or an archive beyond the limits.
    pub fn zip(path: &Path, limits: Limits) -> Result<Self, Error> {
        Self::of_archive(Archive::File(path.to_owned()), limits)
    }

    /// The entries of a zip archive in memory.
    ///
    /// # Errors
    /// As [`Container::zip`].
    pub fn zip_in_memory(bytes: Vec<u8>, limits: Limits) -> Result<Self, Error> {
        Self::of_archive(Archive::Memory(bytes.into()), limits)
    }

    fn of_archive(archive: Archive, limits: Limits) -> Result<Self, Error> {
        let packed = directory(&mut archive.open()?, limits)?;
        let mut warnings = Vec::new();
        let mut entries = Vec::new();
        for (name, packed) in packed {
            if is_outside(&name) {
                warnings.push(format!(
                    "entry `{}` lies outside of the archive and is left out",
                    name.escape_default()
                ));
                continue;
            }
            entries.push(Entry {
                name,
                size: packed.size,
                place: Place::Packed(packed),
            });
        }
        Ok(Self::new(entries, Some(archive), limits, warnings))
    }

    fn new(
        mut entries: Vec<Entry>,
        archive: Option<Archive>,
        limits: Limits,
        warnings: Vec<String>,
    ) -> Self {
        entries.sort_by(|a, b| a.name.cmp(&b.name));
        Self {
            entries,
            archive,
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

    /// The content of an entry. Reading fails where it is damaged.
    ///
    /// # Errors
    /// A file that cannot be opened, or a way of packing that is not known.
    pub fn open(&self, entry: &Entry) -> Result<Box<dyn Read + Send>, Error> {
        match (&entry.place, &self.archive) {
            (Place::File(path), _) => Ok(Box::new(File::open(path)?)),
            (Place::Packed(packed), Some(archive)) => {
                self.limits
                    .check_unpacked(&entry.name, packed.packed_size, packed.size)?;
                unpacked(archive.open()?, packed)
            }
            (Place::Packed(_), None) => Err(Error::refused("an entry without its archive")),
        }
    }

    /// The path of an entry that is a file of its own.
    pub fn path<'a>(&self, entry: &'a Entry) -> Option<&'a Path> {
        match &entry.place {
            Place::File(path) => Some(path),
            Place::Packed(_) => None,
        }
    }
}

/// True for names that lead out of the place where an archive is unpacked.
fn is_outside(name: &str) -> bool {
    let is_drive = name.as_bytes().get(1) == Some(&b':');
    name.starts_with(['/', '\\']) || is_drive || name.split(['/', '\\']).any(|part| part == "..")
}

fn too_many(limits: Limits) -> Error {
    Error::refused(format!(
        "more than {} entries, as no recording has; name the file itself",
        limits.entries
    ))
}

#[cfg(test)]
mod tests;
