//! Binary files and files of tables: the readers of the crate of formats alone, so that a fuzzer can be built of it alone.

use file_formats::make::{self, Packing};
use file_formats::{Container, Limits, Tabular, Wanted};

/// Longest message that a refusal may have, bytes.
const LONGEST_MESSAGE: usize = 4_000;

/// A kind of input and what is done with it.
pub type Target = (&'static str, fn(&[u8]));

/// By the name of the corpus.
pub const FILES: [Target; 12] = [
    ("mat", |bytes| binary("mat", bytes)),
    ("ulog", |bytes| binary("ulog", bytes)),
    ("ardupilot", |bytes| binary("ardupilot", bytes)),
    ("mcap", |bytes| binary("mcap", bytes)),
    ("bag", |bytes| binary("bag", bytes)),
    ("db3", |bytes| binary("db3", bytes)),
    ("sensor_logger_json", |bytes| {
        binary("sensor_logger_json", bytes)
    }),
    ("zip", zip),
    ("json", |bytes| table("json", bytes)),
    // In a build with the feature `tables`; others refuse all files of these.
    ("parquet", |bytes| table("parquet", bytes)),
    ("hdf5", hdf5),
    ("xlsx", workbook),
];

/// # Panics
/// Where a message is longer than anyone reads.
pub fn is_short(error: &impl std::fmt::Display) {
    let length = error.to_string().len();
    assert!(length <= LONGEST_MESSAGE, "a message of {length} bytes");
}

/// What a damaged file may ask for.
const LIMITS: Limits = Limits {
    bytes: 16 << 20,
    entries: 100,
    ratio: 1000,
    rows: 100_000,
};

/// A file of the binary format called `name`.
///
/// # Panics
/// Where a stream has not a stamp for every sample.
fn binary(name: &str, bytes: &[u8]) {
    let format = file_formats::FORMATS.iter().find(|f| f.name == name);
    let Some(format) = format else { return };
    match format.read(&mut &bytes[..], &Wanted::default(), LIMITS) {
        Ok(content) => {
            for stream in &content.streams {
                assert_eq!(stream.stamps.len(), stream.values.len());
            }
            // Lists are cut where they are shown; a warning stands for itself.
            content
                .warnings
                .texts(findings::Front::CommandLine)
                .iter()
                .for_each(is_short);
        }
        Err(error) => is_short(&error),
    }
}

/// A zip archive, every entry of which is unpacked.
fn zip(bytes: &[u8]) {
    let container = match Container::zip_in_memory(bytes.to_vec(), LIMITS) {
        Ok(container) => container,
        Err(error) => return is_short(&error),
    };
    for entry in container.entries() {
        if let Ok(mut content) = container.open(entry) {
            let _ = std::io::copy(&mut content, &mut std::io::sink());
        }
    }
}

/// A file of tables of the format called `name`, every one of which is written as text.
fn table(name: &str, bytes: &[u8]) {
    let limits = Limits {
        rows: 500,
        ..LIMITS
    };
    let Some(format) = Tabular::by_name(name) else {
        return;
    };
    let tables = match Container::tables_in_memory(format, bytes.into(), limits) {
        Ok(tables) => tables,
        Err(error) => return is_short(&error),
    };
    tables
        .warnings
        .texts(findings::Front::CommandLine)
        .iter()
        .for_each(is_short);
    for entry in tables.entries() {
        if let Err(error) = tables.write(entry, &mut std::io::sink()) {
            is_short(&error);
        }
    }
}

/// An HDF5 file as it is, and with the check sums that it should have: the fuzzer does not find them.
fn hdf5(bytes: &[u8]) {
    table("hdf5", bytes);
    #[cfg(feature = "tables")]
    if let Some(bytes) = with_check_sums(bytes) {
        table("hdf5", &bytes);
    }
}

/// The file with right check sums in superblocks, headers of objects, and those of indices of fixed length; none where
/// they are right. "HDF5 File Format Specification", version 3.0.
#[cfg(feature = "tables")]
fn with_check_sums(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut fixed = bytes.to_vec();
    for at in 0..bytes.len() {
        let rest = &bytes[at..];
        let length = match rest.first_chunk() {
            Some(b"\x89HDF") if rest.get(8).is_some_and(|version| *version >= 2) => Some(44),
            Some(b"OHDR") => header_length(rest),
            Some(b"BTHD") => Some(34),
            Some(b"FAHD") => Some(24),
            Some(b"EAHD") => Some(68),
            _ => None,
        };
        let end = length.and_then(|length| at.checked_add(length));
        if let Some(end) = end.filter(|end| end.saturating_add(4) <= fixed.len()) {
            let sum = hdf5_reader::checksum::jenkins_lookup3(&fixed[at..end]);
            fixed[end..end + 4].copy_from_slice(&sum.to_le_bytes());
        }
    }
    (fixed != bytes).then_some(fixed)
}

/// Bytes of an object's header, version 2, before its check sum.
#[cfg(feature = "tables")]
fn header_length(header: &[u8]) -> Option<usize> {
    let flags = *header.get(5)?;
    let times = if flags & 0x20 == 0 { 0 } else { 16 };
    let phases = if flags & 0x10 == 0 { 0 } else { 4 };
    let (from, width) = (6 + times + phases, 1 << (flags & 3));
    let size = header.get(from..from + width)?;
    let size = size
        .iter()
        .rev()
        .fold(0, |sum, byte| sum << 8 | usize::from(*byte));
    size.checked_add(from + width)
}

/// A workbook; what is no zip archive is its texts, a null byte between them: the words, the styles, what is related to
/// what, the list of sheets, a sheet. Packing and check sums would hide them from the fuzzer.
fn workbook(bytes: &[u8]) {
    const NAMES: [&str; 5] = [
        "xl/sharedStrings.xml",
        "xl/styles.xml",
        "xl/_rels/workbook.xml.rels",
        "xl/workbook.xml",
        "xl/worksheets/sheet1.xml",
    ];
    if bytes.starts_with(b"PK") {
        return table("xlsx", bytes);
    }
    const BEGINNING: &[u8] = b"<Relationships><Relationship Type=\"/relationships/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>";
    let texts = bytes.splitn(NAMES.len(), |byte| *byte == 0);
    let entries = NAMES.into_iter().zip(texts);
    let entries = std::iter::once(("_rels/.rels", BEGINNING)).chain(entries);
    let entries = entries.map(|(name, text)| (name, text, Packing::Stored));
    table("xlsx", &make::zip(&entries.collect::<Vec<_>>()));
}
