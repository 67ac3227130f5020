//! Records as JSON lines, so that a study can be interrupted and goes on.

use std::collections::BTreeSet;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Error, Write};
use std::path::Path;

use super::session::Record;

/// A file of records that grows.
#[derive(Debug)]
pub struct Stored {
    file: File,
    done: BTreeSet<(String, u64)>,
}

/// The records in a file; a line that was cut off by an interruption is left out.
///
/// # Errors
/// What the system says.
pub fn read(path: &Path) -> Result<Vec<Record>, Error> {
    let lines = BufReader::new(File::open(path)?).lines();
    let records = lines.map(|line| Ok(serde_json::from_str(&line?).ok()));
    records.filter_map(Result::transpose).collect()
}

impl Stored {
    /// Opens or makes the file.
    ///
    /// # Errors
    /// What the system says.
    pub fn open(path: &Path) -> Result<Self, Error> {
        let done = match path.exists() {
            true => read(path)?.into_iter().map(|r| (r.row, r.seed)).collect(),
            false => BTreeSet::new(),
        };
        let file = OpenOptions::new().create(true).append(true).open(path)?;
        Ok(Self { file, done })
    }

    /// Whether this session is there.
    pub fn has(&self, row: &str, seed: u64) -> bool {
        self.done.contains(&(row.to_owned(), seed))
    }

    /// Adds a record.
    ///
    /// # Errors
    /// What the system says.
    pub fn add(&mut self, record: &Record) -> Result<(), Error> {
        let line = serde_json::to_string(record)?;
        writeln!(self.file, "{line}")
    }
}
