//! Files of tables: JSON, NumPy, Parquet, HDF5 with MATLAB 7.3, Excel workbooks.
//!
//! Their columns have names and no meaning, as those of a text. So a table is read as the comma-separated text that it
//! would be, and one reader of texts knows names, units and sensors. Every reader but those of JSON and NumPy is a
//! feature of the build.

#[cfg(feature = "hdf5")]
mod hdf5;
mod json;
mod npy;
#[cfg(feature = "parquet")]
mod parquet;
mod reader;
mod rows;
mod stream;
#[cfg(feature = "xlsx")]
mod xlsx;

use std::cell::Cell;
use std::io::{Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

use findings::{Finding, Kind, Remedy};

use self::reader::{Listed, Reader};
use crate::store::Store;
use crate::{Error, Limits};

/// A format of tables.
#[derive(Debug)]
pub struct Tabular {
    /// The name to ask for it.
    pub name: &'static str,
    /// Description of the format in one line.
    pub about: &'static str,
    /// Name of such a file in a sentence, with its article.
    pub called: &'static str,
    /// True for the first bytes of such a file.
    begins: fn(&[u8]) -> bool,
    /// Ways out where it is not read.
    instead: fn() -> Vec<Remedy>,
    reader: Option<Reader>,
}

macro_rules! reader {
    ($feature:literal, $reader:path) => {{
        #[cfg(feature = $feature)]
        let reader: Option<Reader> = Some($reader);
        #[cfg(not(feature = $feature))]
        let reader: Option<Reader> = None;
        reader
    }};
}

/// Every format of tables, those among them that this build does not read.
pub static TABULAR: &[Tabular] = &[
    Tabular {
        name: "json",
        about: "JSON: a record per line or in an array, of a sample or of a packet of them, or lists that are columns; names within each other are joined by points",
        called: "a JSON file",
        begins: json::begins,
        instead: || vec![Remedy::SaveAsCsv],
        reader: Some(json::READER),
    },
    Tabular {
        name: "parquet",
        about: "a Parquet file with the columns of a CSV (feature `parquet` of the build)",
        called: "a Parquet file",
        begins: |head| head.starts_with(b"PAR1"),
        instead: || {
            vec![Remedy::ConvertToCsv {
                by: "pandas.read_parquet(FILE).to_csv(OUT)".into(),
            }]
        },
        reader: reader!("parquet", parquet::READER),
    },
    Tabular {
        name: "hdf5",
        about: "an HDF5 or MATLAB 7.3 file: datasets called as the columns of a CSV (feature `hdf5` of the build)",
        called: "an HDF5 or MATLAB 7.3 file",
        begins: |head| {
            head.starts_with(b"\x89HDF\r\n\x1a\n") || head.starts_with(b"MATLAB 7.3 MAT-file")
        },
        instead: || {
            vec![
                Remedy::SaveAsV7,
                Remedy::ExportAs {
                    format: "CSV".into(),
                },
            ]
        },
        reader: reader!("hdf5", hdf5::READER),
    },
    // A zip archive of nothing else is one too.
    Tabular {
        name: "npy",
        about: "NumPy arrays (.npy, .npz): records, arrays called as the columns of a CSV, or a row per sample",
        called: "a NumPy array",
        begins: npy::begins,
        instead: || vec![Remedy::SaveAsCsv],
        reader: Some(npy::READER),
    },
    // A zip archive is a workbook by what is in it.
    Tabular {
        name: "xlsx",
        about: "an Excel workbook, a table per sheet (feature `xlsx` of the build)",
        called: "an Excel workbook",
        begins: |_| false,
        instead: || vec![Remedy::SaveAsCsv],
        reader: reader!("xlsx", xlsx::READER),
    },
];

impl Tabular {
    /// The format called `name`.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        TABULAR.iter().find(|format| format.name == name)
    }

    /// The format of a file that begins with `head`.
    pub fn recognise(head: &[u8]) -> Option<&'static Self> {
        TABULAR.iter().find(|format| (format.begins)(head))
    }

    /// True if this build reads it.
    pub fn is_built(&self) -> bool {
        self.reader.is_some()
    }

    /// Its reader.
    ///
    /// # Errors
    /// A build without it, and what to do.
    fn reader(&self) -> Result<Reader, Error> {
        self.reader.ok_or_else(|| self.not_in_build())
    }

    fn not_in_build(&self) -> Error {
        let found = Finding::of(Kind::NOT_IN_BUILD).detail("format", self.called);
        let build = Remedy::Build {
            feature: self.name.into(),
        };
        Error::refused(found.only_remedies((self.instead)().into_iter().chain([build])))
    }

    /// The tables in `store`.
    pub(crate) fn tables(&self, store: &Store, limits: Limits) -> Result<Listed, Error> {
        let reader = self.reader()?;
        guarded(|| (reader.tables)(store, limits))
    }

    /// Writes the table called `name` as text.
    pub(crate) fn write(
        &self,
        store: &Store,
        name: &str,
        limits: Limits,
        out: &mut dyn Write,
    ) -> Result<(), Error> {
        let reader = self.reader()?;
        guarded(|| (reader.write)(store, name, limits, out))
    }

    /// The same text while it is read.
    pub(crate) fn text(
        &'static self,
        store: &Store,
        name: &str,
        limits: Limits,
    ) -> Result<Box<dyn Read + Send>, Error> {
        self.reader()?;
        let (format, store, name) = (self, store.clone(), name.to_owned());
        stream::text(move |out| format.write(&store, &name, limits, out))
    }
}

/// A Parquet file with `columns` of equal length; what is not finite is a null.
///
/// # Errors
/// A build without the feature `parquet`.
pub fn write_parquet(columns: &[(String, Vec<f64>)]) -> Result<Vec<u8>, Error> {
    #[cfg(feature = "parquet")]
    return parquet::write(columns);
    #[cfg(not(feature = "parquet"))]
    {
        let _ = columns;
        Err(parquet_not_written())
    }
}

#[cfg(any(test, not(feature = "parquet")))]
fn parquet_not_written() -> Error {
    let found = Finding::of(Kind::NOT_WRITTEN_BY_BUILD).detail("format", "Parquet");
    Error::refused(found.remedy(Remedy::Build {
        feature: "parquet".into(),
    }))
}

thread_local! {
    static CATCHES: Cell<bool> = const { Cell::new(false) };
}

/// True while a panic of this thread would be caught and told as damage of a file, so that no hook has to tell it.
pub fn catches_panics() -> bool {
    CATCHES.get()
}

/// Runs a parser of another project. A panic in it becomes an error: the file has damage that the parser did not foresee.
fn guarded<T>(read: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    let before = CATCHES.replace(true);
    let read = catch_unwind(AssertUnwindSafe(read));
    CATCHES.set(before);
    read.unwrap_or_else(|_| Err(Error::refused(Finding::of(Kind::READER_GAVE_UP))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_build_without_a_reader_says_what_to_do() {
        let told = |error: Error, words: &[&str]| {
            let error = error.to_string();
            assert!(words.iter().all(|w| error.contains(w)), "{error}");
        };
        let refused = |name: &str| Tabular::by_name(name).unwrap().not_in_build();
        let parquet = ["a Parquet file", "feature `parquet`", "CSV"];
        told(refused("parquet"), &parquet);
        let hdf5 = ["HDF5", "save -v7", "feature `hdf5`", "CSV"];
        told(refused("hdf5"), &hdf5);
        told(refused("xlsx"), &["Excel", "feature `xlsx`", "CSV"]);
        told(parquet_not_written(), &["feature `parquet`"]);
    }

    #[test]
    fn a_panic_is_known_as_caught_where_it_is() {
        assert!(!catches_panics());
        assert!(guarded(|| Ok(catches_panics())).unwrap());
        assert!(!catches_panics());
    }
}
