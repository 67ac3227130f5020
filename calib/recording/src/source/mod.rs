//! Opening what the user named.

pub mod batches;
pub(crate) mod bounded;
pub mod cut;
pub(crate) mod decode;
mod encoding;
pub(crate) mod files;
pub(crate) mod head;
mod input;
pub(crate) mod lines;
pub(crate) mod on_disk;
mod open;
pub mod pipeline;
pub(crate) mod place;
pub(crate) mod rewrite;

use std::fs::File;
use std::io::{self, Cursor, IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use file_formats::{Container, Entry, Tabular};
use findings::{Finding, Kind, OptionName, Remedy};

use crate::Error;
use crate::header::sniff::Start;
use crate::recording::options::ReadOptions;
use crate::shown::shown_path;
use crate::source::files::{Files, limits};
pub use crate::source::input::Input;
use crate::source::input::Origin;
use crate::source::on_disk::{Unchanged, explained};
use crate::source::place::in_file;

/// Content of a path.
#[derive(Debug)]
pub enum Source {
    /// A folder or an archive.
    Files(Files),
    /// A text, opened and decoded.
    Text(Input),
    /// A binary or structured file of a known format.
    Binary(Binary),
    /// The text of the only table in a file of that format, or the texts of all.
    Tables(&'static Tabular, Box<Source>),
}

/// A binary or structured file that is about to be read.
pub struct Binary {
    /// The name in messages.
    pub(crate) name: String,
    /// Its format.
    pub(crate) format: &'static file_formats::Format,
    /// All of it.
    pub(crate) reader: Box<dyn Read + Send>,
    /// The file itself, if it is one and not packed: it can be sought in.
    pub(crate) path: Option<PathBuf>,
    /// The file as it was when it was opened.
    pub(crate) unchanged: Option<Unchanged>,
}

impl std::fmt::Debug for Binary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Binary")
            .field("name", &self.name)
            .field("format", &self.format)
            .finish_non_exhaustive()
    }
}

impl Source {
    /// Opens `path`, `-` being standard input, decompressed and texts as UTF-8.
    pub(crate) fn open(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        if path.as_os_str() == "-" {
            return Self::standard_input(options);
        }
        let name = shown_path(path);
        let file = File::open(path).map_err(|error| explained(path, error))?;
        let metadata = file.metadata().map_err(|error| explained(path, error))?;
        if metadata.is_dir() {
            return Ok(Self::Files(Files::folder(name, path, options)?));
        }
        if metadata.is_file() && metadata.len() > options.max_bytes {
            return Err(in_file(
                &name,
                Finding::of(Kind::FILE_TOO_LARGE)
                    .detail("size", bytes(metadata.len() as f64))
                    .number("rows", metadata.len() as f64 / 70.0, "count")
                    .detail("memory", bytes(metadata.len() as f64 / 70.0 * 128.0))
                    .detail("limit", bytes(options.max_bytes as f64))
                    .only_remedies([Remedy::set_to(
                        OptionName::MaxBytes,
                        metadata.len().to_string(),
                    )]),
            ));
        }
        let unchanged = metadata.is_file().then(|| Unchanged::new(path, &metadata));
        let origin = match unchanged {
            Some(_) => Origin::Path(path.to_owned()),
            None => Origin::Stream,
        };
        let mut source = Self::of(name, Box::new(file), origin, options)?;
        match &mut source {
            Self::Text(input) => {
                input.unchanged = unchanged;
                input.warn_of_extension(path);
            }
            Self::Binary(binary) => binary.unchanged = unchanged,
            Self::Tables(_, inner) => {
                if let Self::Text(input) = &mut **inner {
                    input.unchanged = unchanged;
                }
            }
            Self::Files(_) => {}
        }
        Ok(source)
    }

    fn standard_input(options: &ReadOptions) -> Result<Self, Error> {
        if io::stdin().is_terminal() {
            return Err(Error::usage(Finding::of(Kind::INPUT_IS_TERMINAL)));
        }
        Self::of(
            "<stdin>".to_owned(),
            Box::new(io::stdin()),
            Origin::Stream,
            options,
        )
    }

    /// Bytes in memory.
    pub(crate) fn of_bytes(
        name: &str,
        bytes: Arc<[u8]>,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        let reader = Box::new(Cursor::new(bytes.clone()));
        Self::of(name.to_owned(), reader, Origin::Memory(bytes), options)
    }

    /// An entry of a container.
    pub(crate) fn of_entry(
        files: &Files,
        entry: &Entry,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        let origin = Origin::Entry(files.clone(), entry.clone());
        Self::of(files.called(entry), files.open(entry)?, origin, options)
    }

    /// Any stream of bytes: content decides what it is.
    fn of(
        name: String,
        reader: Box<dyn Read + Send>,
        origin: Origin,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        let unpacked = decode::unpacked(&name, reader)?;
        decode::refuse_own(&name, &unpacked.head)?;
        let is_nested = matches!(origin, Origin::Entry(..));
        if unpacked.head.starts_with(ZIP) && !is_nested {
            return archive(name, unpacked, &origin, options);
        }
        if let Some(format) = file_formats::recognise(&unpacked.head) {
            return Ok(Self::Binary(Binary {
                name,
                format,
                path: match origin {
                    Origin::Path(path) if !unpacked.packed => Some(path),
                    _ => None,
                },
                reader: unpacked.reader,
                unchanged: None,
            }));
        }
        if let Some(format) = Tabular::recognise(&unpacked.head) {
            return tables(name, format, unpacked, &origin, options);
        }
        Input::new(name, unpacked, origin, options).map(Self::Text)
    }

    /// The files that it consists of, if any.
    pub(crate) fn files(&self) -> Option<&Files> {
        match self {
            Self::Files(files) => Some(files),
            Self::Tables(_, inner) => inner.files(),
            Self::Text(_) | Self::Binary(_) => None,
        }
    }

    /// True for a text with rows that are understood, or asked about.
    pub(crate) fn holds_samples(&self, options: &ReadOptions) -> bool {
        match self {
            Self::Files(_) => false,
            Self::Binary(_) => true,
            Self::Text(input) => Start::look(&input.name, &input.head, None, options).is_ok(),
            Self::Tables(_, inner) => match **inner {
                Self::Files(_) => true,
                _ => inner.holds_samples(options),
            },
        }
    }

    /// Returns the content of a file of tables, or any other source unchanged.
    pub(crate) fn within(self) -> Self {
        match self {
            Self::Tables(_, inner) => *inner,
            other => other,
        }
    }

    /// The text that it is.
    ///
    /// # Errors
    /// Anything that is not one file of text.
    pub(crate) fn into_text(self) -> Result<Input, Error> {
        match self.within() {
            Self::Text(input) => Ok(input),
            Self::Files(files) => {
                let several = Finding::of(Kind::SEVERAL_FILES).detail("holder", files.kind());
                Err(in_file(&files.name, several))
            }
            Self::Binary(binary) => Err(in_file(&binary.name, Finding::of(Kind::NO_TEXT))),
            Self::Tables(_, inner) => inner.into_text(),
        }
    }

    /// The name in messages.
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::Files(files) => &files.name,
            Self::Text(input) => &input.name,
            Self::Binary(binary) => &binary.name,
            Self::Tables(_, inner) => inner.name(),
        }
    }
}

/// Bytes that a zip archive begins with.
const ZIP: &[u8] = b"PK\x03\x04";

/// The files of a zip archive, or the tables of a workbook or of arrays.
fn archive(
    name: String,
    mut unpacked: decode::Unpacked,
    origin: &Origin,
    options: &ReadOptions,
) -> Result<Source, Error> {
    let limits = limits(options);
    let (path, bytes) = place(&name, &mut unpacked, origin, options)?;
    let container = match path {
        Some(path) => Container::zip(path, limits),
        None => Container::zip_in_memory(bytes.clone(), limits),
    };
    let container = container.map_err(|error| Error::input(error.finding().in_file(&name)))?;
    let files = Files::new(name, container);
    let has_arrays = files
        .entries()
        .iter()
        .all(|entry| entry.name.ends_with(".npy"));
    let format = match (files.entry("xl/workbook.xml"), files.entries()) {
        (Some(_), _) => Tabular::by_name("xlsx"),
        (None, [_, ..]) if has_arrays => Tabular::by_name("npy"),
        _ => None,
    };
    match format {
        Some(format) => tables_of(files.name, format, path, bytes, options),
        None => Ok(Source::Files(files)),
    }
}

/// The tables of a file of `format`.
fn tables(
    name: String,
    format: &'static Tabular,
    mut unpacked: decode::Unpacked,
    origin: &Origin,
    options: &ReadOptions,
) -> Result<Source, Error> {
    let (path, bytes) = match format.is_built() {
        true => place(&name, &mut unpacked, origin, options)?,
        // It is refused unread.
        false => (None, Arc::default()),
    };
    tables_of(name, format, path, bytes, options)
}

fn tables_of(
    name: String,
    format: &'static Tabular,
    path: Option<&Path>,
    bytes: Arc<[u8]>,
    options: &ReadOptions,
) -> Result<Source, Error> {
    let limits = limits(options);
    let container = match path {
        Some(path) => Container::tables(format, path, limits),
        None => Container::tables_in_memory(format, bytes, limits),
    };
    let container = container.map_err(|error| Error::input(error.finding().in_file(&name)))?;
    let files = Files::new(name, container);
    let inner = match files.entries() {
        [only] => {
            let mut source = files.source(only, options)?;
            if let Source::Text(input) = &mut source {
                input.warnings.extend(files.warnings());
            }
            source
        }
        _ => Source::Files(files),
    };
    Ok(Source::Tables(format, Box::new(inner)))
}

/// Returns a form of a file that allows seeking: its path on the disk, else its bytes in memory.
fn place<'o>(
    name: &str,
    unpacked: &mut decode::Unpacked,
    origin: &'o Origin,
    options: &ReadOptions,
) -> Result<(Option<&'o Path>, Arc<[u8]>), Error> {
    let path = match origin {
        Origin::Path(path) => Some(path.as_path()),
        Origin::Entry(files, entry) => files.path(entry),
        Origin::Memory(bytes) if !unpacked.packed => return Ok((None, bytes.clone())),
        _ => None,
    };
    if let Some(path) = path.filter(|_| !unpacked.packed) {
        return Ok((Some(path), Arc::default()));
    }
    let limit = limits(options).bytes;
    let mut bytes = Vec::new();
    let read = (&mut unpacked.reader).take(limit.saturating_add(1));
    let read = { read }.read_to_end(&mut bytes);
    read.map_err(|error| head::stopped(name, &error))?;
    if bytes.len() as u64 > limit {
        let found = Finding::of(Kind::TOO_MANY_BYTES).count("limit", limit as usize);
        return Err(in_file(name, found.only_remedies([])));
    }
    Ok((None, bytes.into()))
}

/// A number of bytes for people.
fn bytes(count: f64) -> String {
    let units = [(1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let unit = units.into_iter().find(|(size, _)| count >= *size);
    unit.map_or_else(
        || format!("{count:.0} bytes"),
        |(size, name)| format!("{:.1} {name}", count / size),
    )
}
