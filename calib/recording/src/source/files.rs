//! A folder or an archive as files that can be opened by name.

use findings::{Finding, Kind};
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::sync::{Arc, OnceLock};

use file_formats::{Container, Entry, Limits};

use super::head::stopped;
use super::place::in_file;
use crate::Error;
use crate::recording::options::ReadOptions;
use crate::shown::shown;

/// Entries whose beginnings are looked at.
const LOOKED_AT: usize = 500;
/// Bytes of a beginning.
const HEAD: u64 = 8 << 10;

/// The files of a folder or an archive.
#[derive(Clone, Debug)]
pub struct Files {
    /// The name in messages.
    pub(crate) name: String,
    container: Arc<Container>,
    /// The first of those whose beginning the system did not let be read, shared by all copies.
    unread: Arc<OnceLock<Unread>>,
}

/// A file that the system did not let be read when it was looked at.
#[derive(Debug)]
struct Unread {
    name: String,
    error: std::io::Error,
}

/// The limits that the options set.
pub(crate) fn limits(options: &ReadOptions) -> Limits {
    let limits = Limits::default();
    Limits {
        bytes: limits.bytes.min(options.max_bytes),
        rows: options.max_rows,
        ..limits
    }
}

impl Files {
    /// The files of `container`.
    pub(crate) fn new(name: String, container: Container) -> Self {
        Self {
            name,
            container: Arc::new(container),
            unread: Arc::default(),
        }
    }

    /// The files in the folder at `path`.
    pub(crate) fn folder(name: String, path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        let container = match Container::folder(path, limits(options)) {
            Ok(container) => container,
            Err(file_formats::Error::Io(error)) => {
                return Err(crate::source::on_disk::explained(path, error));
            }
            Err(error) => return Err(Error::input(error.finding().in_file(name))),
        };
        Ok(Self::new(name, container))
    }

    /// All of them, in the order of their names.
    pub(crate) fn entries(&self) -> &[Entry] {
        self.container.entries()
    }

    /// The entry called `name`.
    pub(crate) fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries().iter().find(|entry| entry.name == name)
    }

    /// True for a zip archive.
    pub(crate) fn is_archive(&self) -> bool {
        self.container.is_archive()
    }

    /// Returns the kind of container, in words.
    pub(crate) fn kind(&self) -> &'static str {
        match (self.container.tabular(), self.is_archive()) {
            (Some(format), _) => format.called,
            (None, true) => "an archive",
            (None, false) => "a folder",
        }
    }

    /// True for the tables of a file, whose names have no extension.
    pub(crate) fn are_tables(&self) -> bool {
        self.container.tabular().is_some()
    }

    /// The path of an entry that is a file of its own.
    pub(crate) fn path<'a>(&self, entry: &'a Entry) -> Option<&'a Path> {
        self.container.path(entry)
    }

    /// Returns the warnings about entries that were left out.
    pub(crate) fn warnings(&self) -> impl Iterator<Item = Finding> + '_ {
        let warnings = self.container.warnings.iter();
        warnings.map(|finding| finding.clone().in_recording(&self.name))
    }

    /// An entry's name in messages.
    pub(crate) fn called(&self, entry: &Entry) -> String {
        match entry.name.is_empty() {
            // The only table of a file.
            true => self.name.clone(),
            false => format!("{}/{}", self.name, shown(&entry.name)),
        }
    }

    /// The first bytes of an entry; none of one that cannot be opened.
    pub(crate) fn head(&self, entry: &Entry) -> Vec<u8> {
        let mut head = Vec::new();
        let read = self.container.open(entry).and_then(|reader| {
            reader.take(HEAD).read_to_end(&mut head)?;
            Ok(())
        });
        // A damaged entry is refused by whoever reads it, and one that is closed to the user holds nothing for us.
        if let Err(file_formats::Error::Io(error)) = read
            && error.raw_os_error().is_some()
            && error.kind() != ErrorKind::PermissionDenied
        {
            let name = self.called(entry);
            let _ = self.unread.set(Unread { name, error });
        }
        head
    }

    /// Refuses them where the beginning of one could not be read: nobody can tell whether it belongs to the recording.
    ///
    /// # Errors
    /// The system's reason.
    pub(crate) fn refuse_unread(&self) -> Result<(), Error> {
        match self.unread.get() {
            Some(Unread { name, error }) => Err(stopped(name, error)),
            None => Ok(()),
        }
    }

    /// The entries whose beginnings are worth a look, with those beginnings.
    pub(crate) fn heads(&self) -> Vec<(&Entry, Vec<u8>)> {
        let entries = self.entries().iter().take(LOOKED_AT);
        entries.map(|entry| (entry, self.head(entry))).collect()
    }

    /// The content of an entry.
    pub(crate) fn open(&self, entry: &Entry) -> Result<Box<dyn Read + Send>, Error> {
        let opened = self.container.open(entry);
        opened.map_err(|error| Error::input(error.finding().in_file(self.called(entry))))
    }

    /// Builds the error that no entry is called `name`.
    pub(crate) fn no_entry(&self, name: &str) -> Error {
        let found = Finding::of(Kind::NO_ENTRY)
            .detail("entry", shown(name))
            .detail("listed", self.listed());
        let known = self.entries().iter().map(|entry| entry.name.as_str());
        in_file(&self.name, found.or_nearest(name, known))
    }

    /// Builds the error that no entry is a recording.
    pub(crate) fn without_recording(&self) -> Error {
        let found = Finding::of(Kind::NO_RECORDING_IN_FOLDER)
            .detail("holder", self.kind())
            .detail("listed", self.listed());
        in_file(&self.name, found)
    }

    /// Builds the error that two entries have the same sensor.
    pub(crate) fn of_one_sensor(&self, first: &str, second: &str) -> Error {
        let found = Finding::of(Kind::FILES_OF_ONE_SENSOR)
            .detail("first", first)
            .detail("second", second);
        in_file(&self.name, found)
    }

    /// The names of the entries, for messages.
    pub(crate) fn listed(&self) -> String {
        let names: Vec<_> = self
            .entries()
            .iter()
            .take(10)
            .map(|e| shown(&e.name))
            .collect();
        match (names.is_empty(), self.entries().len().saturating_sub(10)) {
            (true, _) => "nothing".to_owned(),
            (false, 0) => names.join(", "),
            (false, more) => format!("{} and {more} more", names.join(", ")),
        }
    }
}
