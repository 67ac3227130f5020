//! From a path, an entry or what was read before to a text or whatever else is there.

use std::path::Path;

use file_formats::Entry;
use findings::{Finding, Kind};

use super::Source;
use super::files::Files;
use super::input::{Input, Origin};
use super::place::in_file;
use crate::Error;
use crate::recording::options::ReadOptions;

impl Input {
    /// Opens the text at `path`, as [`Source::open`] does.
    pub(crate) fn open(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        Source::open(path, options)?.into_text()
    }

    /// The same text from its beginning.
    ///
    /// # Errors
    /// Text that went by, as that of standard input.
    pub(crate) fn again(&self, options: &ReadOptions) -> Result<Self, Error> {
        match &self.origin {
            Origin::Path(path) => Self::open(path, options),
            Origin::Entry(files, entry) => files.text(entry, options),
            Origin::Memory(bytes) => {
                Source::of_bytes(&self.name, bytes.clone(), options)?.into_text()
            }
            Origin::Stream => Err(in_file(&self.name, Finding::of(Kind::READ_TWICE))),
        }
    }
}

impl Files {
    /// The entry as a recording of its own.
    pub(crate) fn source(&self, entry: &Entry, options: &ReadOptions) -> Result<Source, Error> {
        Source::of_entry(self, entry, options)
    }

    /// The text in an entry.
    pub(crate) fn text(&self, entry: &Entry, options: &ReadOptions) -> Result<Input, Error> {
        self.source(entry, options)?.into_text()
    }
}
