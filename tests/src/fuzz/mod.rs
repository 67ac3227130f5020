//! What the coverage-guided fuzzers and the replay of their corpus run: one function per kind of input.
//!
//! Each takes any bytes and panics where something does not hold that has to hold whatever the input is. Being refused is fine.

pub mod files;

use std::cell::RefCell;
use std::path::PathBuf;

use calib::Recording;
use calib::discover::noise_in;
use calib::effect_file::parse_effects;
use calib::intervals::read_sections;
use calib::recording::{ColumnMap, ReadOptions, Stream};
use calib::simulate::{Simulation, Spec};
pub use files::Target;
use files::is_short;
use nalgebra::Vector3;
use sensor::expression::Expression;
use solver::Jet;
use tempfile::NamedTempFile;

/// What is a text or made of texts, by the name of its corpus.
const TEXTS: [Target; 10] = [
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
];

/// Every target, by the name of its corpus.
pub fn targets() -> impl Iterator<Item = Target> {
    TEXTS.into_iter().chain(files::FILES)
}

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
            recording
                .warnings
                .texts(findings::Front::CommandLine)
                .iter()
                .for_each(is_short);
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
