//! The trait that every format of recordings implements.

use std::fmt;

use findings::{Finding, Kind};

use crate::Error;
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::source::files::Files;
use crate::source::{Input, Source};

/// A format of recordings.
pub trait Format: fmt::Debug + Sync {
    /// The name for `--format`.
    fn name(&self) -> &'static str;

    /// Description of the format in one line.
    fn about(&self) -> &'static str;

    /// True if the content is of this format. The first format of [`FORMATS`](super::FORMATS) that says so reads it.
    fn recognises(&self, source: &Source) -> bool;

    /// Reads all of it.
    ///
    /// # Errors
    /// [`Error::Input`] naming the place, what was found and what to do.
    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error>;
}

/// Finds the format of what is in a source.
pub(crate) type Recognise = fn(&Source) -> Option<&'static dyn Format>;

/// The text in `source`; anything else is refused by name of the format.
pub(super) fn text(source: Source, format: &dyn Format) -> Result<Input, Error> {
    match source.within() {
        Source::Text(input) => Ok(input),
        other => Err(mismatch(other.name(), format, "texts")),
    }
}

/// The files in `source`; anything else is refused by name of the format.
pub(super) fn files(source: Source, format: &dyn Format) -> Result<Files, Error> {
    match source.within() {
        Source::Files(files) => Ok(files),
        other => Err(mismatch(other.name(), format, "folders and archives")),
    }
}

pub(super) fn mismatch(name: &str, format: &dyn Format, expected: &str) -> Error {
    Error::usage(
        Finding::of(Kind::OTHER_FORMAT)
            .in_file(name)
            .detail("format", format.name())
            .detail("expected", expected),
    )
}
