//! The trait that every reader of tables implements.

use findings::Findings;
use std::fmt;
use std::io::Write;

use crate::store::Store;
use crate::{Error, Limits};

/// Reader of a format of tables.
pub(crate) trait Reader: fmt::Debug + Sync {
    /// The tables in the file.
    fn tables(&self, store: &Store, limits: Limits) -> Result<Listed, Error>;

    /// Writes the table called `name` as comma-separated text, its names first.
    fn write(
        &self,
        store: &Store,
        name: &str,
        limits: Limits,
        out: &mut dyn Write,
    ) -> Result<(), Error>;
}

/// The tables of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Listed {
    /// Their names; empty of the only one.
    pub names: Vec<String>,
    /// Warnings about content that was left out.
    pub warnings: Findings,
}
