//! The formats that recordings come in: one file and one line in [`FORMATS`] each.

mod csv;
mod folder;
mod imu_tk;

use std::fmt;
use std::path::Path;

use super::source::Input;
use super::{ReadOptions, Recording};
use crate::Error;

/// What a path leads to.
#[derive(Debug)]
pub enum Source<'a> {
    /// A folder.
    Folder(&'a Path),
    /// A text, opened and decoded.
    Text(Input),
}

impl Source<'_> {
    /// The first bytes of a text; nothing for a folder.
    pub fn head(&self) -> &[u8] {
        match self {
            Self::Folder(_) => &[],
            Self::Text(input) => &input.head,
        }
    }
}

/// A format of recordings.
pub trait Format: fmt::Debug + Sync {
    /// The name for `--format`.
    fn name(&self) -> &'static str;

    /// What it is, in a line.
    fn about(&self) -> &'static str;

    /// True if the content is of this format. The first format of [`FORMATS`] that says so reads it.
    fn recognises(&self, source: &Source<'_>) -> bool;

    /// Reads all of it.
    ///
    /// # Errors
    /// [`Error::Input`] naming the place, what was found and what to do.
    fn read(&self, source: Source<'_>, options: &ReadOptions) -> Result<Recording, Error>;
}

/// Every format.
pub static FORMATS: &[&dyn Format] = &[&folder::Folder, &imu_tk::ImuTk, &csv::Csv];

/// The format called `name`.
///
/// # Errors
/// The names there are.
pub fn by_name(name: &str) -> Result<&'static dyn Format, String> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.name() == name)
        .ok_or_else(|| {
            let names: Vec<_> = FORMATS.iter().map(|format| format.name()).collect();
            format!("no format `{name}`; known: {}", names.join(", "))
        })
}

/// The format of `source`.
pub(super) fn recognise(source: &Source<'_>) -> Option<&'static dyn Format> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.recognises(source))
}

/// The text in `source`; a folder is refused by name of the format.
fn text(source: Source<'_>, format: &dyn Format) -> Result<Input, Error> {
    match source {
        Source::Text(input) => Ok(input),
        Source::Folder(path) => Err(Error::Usage(format!(
            "{}: a folder, but --format {} reads a file",
            super::place::shown_path(path),
            format.name()
        ))),
    }
}
