//! A reader of tables, as data.

use findings::Findings;
use std::io::Write;

use crate::store::Store;
use crate::{Error, Limits};

/// A reader that finds the tables of a file and writes them as text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reader {
    /// Finds the tables.
    pub tables: fn(&Store, Limits) -> Result<Listed, Error>,
    /// Writes the table called so as comma-separated text, its names first.
    pub write: fn(&Store, &str, Limits, &mut dyn Write) -> Result<(), Error>,
}

/// The tables of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Listed {
    /// Their names; empty of the only one.
    pub names: Vec<String>,
    /// Warnings about content that was left out.
    pub warnings: Findings,
}
