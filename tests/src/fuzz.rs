//! What the coverage-guided fuzzers and the replay of their corpus run: one function per kind of input.
//!
//! Each takes any bytes and panics where something does not hold that has to hold whatever the input is. Being refused is fine.

use std::cell::RefCell;
use std::path::PathBuf;

use calib::Recording;
use calib::discover::noise_in;
use calib::effect_file::parse_effects;
use calib::intervals::read_sections;
use calib::recording::{ColumnMap, ReadOptions, Stream};
use calib::simulate::{Simulation, Spec};
use file_formats::make::{self, Packing};
use file_formats::{Container, Limits, Tabular, Wanted};
use nalgebra::Vector3;
use sensor::expression::Expression;
use solver::Jet;
use tempfile::NamedTempFile;

/// Longest message that a refusal may have, bytes.
const LONGEST_MESSAGE: usize = 4_000;

/// A kind of input and what is done with it.
pub type Target = (&'static str, fn(&[u8]));

/// Every target, by the name of its corpus.
pub const TARGETS: [Target; 21] = [
    ("recording", recording),
    ("header", header),
    ("columns", columns),
    ("expression", expression),
    ("effects", effects),
    ("spec", spec),
    ("calibration", calibration_file),
    ("noise", noise),
    ("tables", tables),
    ("findings", calibration_file),
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
    // In a build with the feature `tables`; others refuse all files of these.
    ("parquet", |bytes| table("parquet", bytes)),
    ("hdf5", hdf5),
    ("xlsx", workbook),
];

thread_local! {
    static SCRATCH: RefCell<Option<NamedTempFile>> = const { RefCell::new(None) };
}

/// The path of a file with this content; the next call of the same thread overwrites it.
///
/// # Panics
/// Where the folder for temporary files cannot be written.
#[expect(clippy::expect_used, reason = "a fuzzer cannot go on without its file")]
fn file_with(bytes: &[u8]) -> PathBuf {
    SCRATCH.with_borrow_mut(|scratch| {
        let file = scratch.get_or_insert_with(|| NamedTempFile::new().expect("a temporary file"));
        let path = file.path().to_owned();
        std::fs::write(&path, bytes).expect("writable");
        path
    })
}

fn is_short(error: &impl std::fmt::Display) {
    let length = error.to_string().len();
    assert!(length <= LONGEST_MESSAGE, "a message of {length} bytes");
}

fn is_sound(stream: &Stream) {
    assert_eq!(stream.t.len(), stream.values.len());
    assert!(
        stream.t.windows(2).all(|pair| pair[0] < pair[1]),
        "time increases"
    );
    assert!(stream.t.iter().all(|t| t.is_finite()), "finite stamps");
    let mut values = stream.values.iter().flat_map(Vector3::iter);
    assert!(values.all(|v| v.is_finite()), "finite samples");
}

fn read(bytes: &[u8], options: &ReadOptions) {
    match Recording::from_bytes("recording", bytes, options) {
        Ok(recording) => {
            let streams = [&recording.accelerometer, &recording.gyroscope];
            streams.into_iter().flatten().for_each(is_sound);
            recording.warnings.iter().for_each(is_short);
        }
        Err(error) => is_short(&error),
    }
}

/// A recording in any text; the first byte chooses the options.
fn recording(bytes: &[u8]) {
    let Some((choice, rest)) = bytes.split_first() else {
        return;
    };
    let options = ReadOptions {
        na_drop: choice & 1 != 0,
        sort_time: choice & 2 != 0,
        rate: (choice & 4 != 0).then_some(100.0),
        skip_bad_rows: usize::from(choice >> 6),
        ..ReadOptions::default()
    };
    read(rest, &options);
}

/// A header, a row of units or a preface in front of good rows: few, as every execution reads them.
fn header(bytes: &[u8]) {
    let mut text = bytes.to_vec();
    for k in 0..12 {
        let (s, c) = (f64::from(k) * 0.02).sin_cos();
        let row = format!(
            "\n{:.2},{:.4},{:.4},0.1,{s:.4},{c:.4},2",
            0.01 * f64::from(k),
            9.8 * c,
            9.8 * s
        );
        text.extend_from_slice(row.as_bytes());
    }
    read(&text, &ReadOptions::default());
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
    let format = file_formats::FORMATS.iter().find(|f| f.name() == name);
    let Some(format) = format else { return };
    match format.read(&mut &bytes[..], &Wanted::default(), LIMITS) {
        Ok(content) => {
            for stream in &content.streams {
                assert_eq!(stream.stamps.len(), stream.values.len());
            }
            // Lists are cut where they are shown; a warning stands for itself.
            content.warnings.iter().for_each(is_short);
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
    tables.warnings.iter().for_each(is_short);
    for entry in tables.entries() {
        let text = tables.open(entry);
        let read = text.map(|mut text| std::io::copy(&mut text, &mut std::io::sink()));
        if let Ok(Err(error)) = read {
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

/// What `--columns` takes.
fn columns(bytes: &[u8]) {
    if let Err(error) = String::from_utf8_lossy(bytes).parse::<ColumnMap>() {
        is_short(&error);
    }
}

/// An expression of an effect: read, weighed and evaluated. Not made an effect, as those live as long as the program.
fn expression(bytes: &[u8]) {
    match Expression::parse(&String::from_utf8_lossy(bytes), &["k", "wx", "temperature"]) {
        Ok(expression) if expression.cost() < 1000 => {
            let at = |k: usize| 0.5 - k as f64;
            let _: f64 = expression.eval(&at);
            let _: Jet = expression.eval(&|k| Jet::from(at(k)));
        }
        Ok(_) => {}
        Err(error) => is_short(&error),
    }
}

/// A file of effects.
fn effects(bytes: &[u8]) {
    if let Err(error) = parse_effects(&String::from_utf8_lossy(bytes), "effects.toml") {
        is_short(&error);
    }
}

/// What to simulate: read and planned, not run.
fn spec(bytes: &[u8]) {
    let spec = Spec::from_toml(&String::from_utf8_lossy(bytes), "spec.toml");
    if let Err(error) = spec.and_then(|spec| Simulation::new(&spec).map(drop)) {
        is_short(&error);
    }
}

/// A calibration.
fn calibration_file(bytes: &[u8]) {
    match calib::calibration::load(&file_with(bytes)) {
        Ok(found) => {
            let again = serde_json::to_string(&found);
            assert!(again.is_ok(), "what was read can be written");
        }
        Err(error) => is_short(&error),
    }
}

/// Noise densities as `allan` writes them.
fn noise(bytes: &[u8]) {
    if let Err(error) = noise_in(&file_with(bytes)) {
        is_short(&error);
    }
}

/// Tables of static intervals and of static means.
fn tables(bytes: &[u8]) {
    let path = file_with(bytes);
    let stream = Stream {
        t: (0..100).map(f64::from).collect(),
        values: vec![Vector3::z(); 100],
    };
    let recording = Recording {
        accelerometer: Some(stream),
        ..Recording::default()
    };
    if let Err(error) = read_sections(&path, &recording) {
        is_short(&error);
    }
    if let Err(error) = calib::calibrate::read_static_means(&path) {
        is_short(&error);
    }
}
