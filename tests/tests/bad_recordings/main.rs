//! Recordings as they should not be: what is refused and where, what is read and with which words.
//!
//! Row numbers are those of the project's catalogue of bad inputs; every file is made here.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod encodings;
mod files;
mod never_panics;
mod phone;
mod time_stamps;
mod values;

use std::path::PathBuf;

use calib::recording::ReadOptions;
use calib::{Error, Recording};
use tempfile::TempDir;

/// The plain header.
pub const HEADER: &str = "t,ax,ay,az,gx,gy,gz";

/// Rows of a device that turns slowly and steadily: 100 Hz, gravity on every axis in turn.
pub fn rows(count: usize) -> Vec<String> {
    (0..count).map(|i| row(0.01 * i as f64, i)).collect()
}

/// One row with the stamp `t`.
pub fn row(t: f64, i: usize) -> String {
    let (s, c) = (i as f64 * 0.02).sin_cos();
    let z = 0.1 * (i as f64 * 0.7).sin();
    format!(
        "{t:.4},{:.6},{:.6},{z:.6},{:.6},{:.6},{:.6}",
        9.8 * c,
        9.8 * s,
        0.01 * s,
        0.01 * c,
        2.0 + 0.01 * z
    )
}

/// A header, `rows` and their line ends.
pub fn file(header: &str, rows: &[String]) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        text.push_str(row);
        text.push('\n');
    }
    text
}

/// A file in a folder of its own.
#[derive(Debug)]
pub struct Place {
    folder: TempDir,
    name: String,
}

impl Place {
    pub fn new(name: &str, content: &[u8]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(name), content).unwrap();
        Self {
            folder,
            name: name.to_owned(),
        }
    }

    pub fn path(&self) -> PathBuf {
        self.folder.path().join(&self.name)
    }

    pub fn folder(&self) -> PathBuf {
        self.folder.path().to_owned()
    }
}

/// What reading `content` gives; messages without the folder's name.
pub fn read(content: impl AsRef<[u8]>, options: &ReadOptions) -> Result<Recording, Error> {
    Recording::read(&Place::new("r.csv", content.as_ref()).path(), options)
}

/// Asserts that `content` is refused as an input, at `place` (`3:7` for line and column), in words that
/// hold all of `words`.
#[track_caller]
pub fn refused(content: impl AsRef<[u8]>, place: &str, words: &[&str]) {
    refused_with(content, &ReadOptions::default(), place, words);
}

#[track_caller]
pub fn refused_with(content: impl AsRef<[u8]>, options: &ReadOptions, place: &str, words: &[&str]) {
    let error = read(content, options).expect_err("is refused");
    let Error::Input(found) = &error else {
        panic!("not an input error: {error:?}")
    };
    let message = found.text(findings::Front::CommandLine);
    let after = message
        .split_once("r.csv:")
        .unwrap_or_else(|| panic!("no file: {message}"))
        .1;
    let place = if place.is_empty() {
        " ".to_owned()
    } else {
        format!("{place}: ")
    };
    assert!(
        after.starts_with(&place),
        "expected `{place}` in: {message}"
    );
    for word in words {
        assert!(message.contains(word), "expected `{word}` in: {message}");
    }
}

/// Asserts that `content` is read with exactly one warning, which holds all of `words`.
#[track_caller]
pub fn warned(content: impl AsRef<[u8]>, words: &[&str]) -> Recording {
    warned_with(content, &ReadOptions::default(), words)
}

#[track_caller]
pub fn warned_with(content: impl AsRef<[u8]>, options: &ReadOptions, words: &[&str]) -> Recording {
    let recording = read(content, options).unwrap();
    assert_eq!(recording.warnings.len(), 1, "{:#?}", recording.warnings);
    for word in words {
        assert!(
            recording.warnings.texts(findings::Front::CommandLine)[0].contains(word),
            "`{word}` in {}",
            recording.warnings.texts(findings::Front::CommandLine)[0]
        );
    }
    recording
}

/// Asserts that `content` is read without a word as `rows(count)` are.
#[track_caller]
pub fn read_as_usual(content: impl AsRef<[u8]>, count: usize) {
    let recording = read(content, &ReadOptions::default()).unwrap();
    assert_eq!(
        recording.warnings.texts(findings::Front::CommandLine),
        Vec::<String>::new()
    );
    assert_same_samples(&recording, count);
}

/// Asserts that the samples are those of `rows(count)`.
#[track_caller]
pub fn assert_same_samples(recording: &Recording, count: usize) {
    let usual = read(file(HEADER, &rows(count)), &ReadOptions::default()).unwrap();
    assert_eq!(recording.accelerometer, usual.accelerometer);
    assert_eq!(recording.gyroscope, usual.gyroscope);
}

#[test]
fn the_usual_file_is_read_without_a_word() {
    let recording = read(file(HEADER, &rows(300)), &ReadOptions::default()).unwrap();
    assert_eq!(
        recording.warnings.texts(findings::Front::CommandLine),
        Vec::<String>::new()
    );
    let accel = recording.accelerometer.unwrap();
    assert_eq!(
        (accel.len(), accel.t[299], accel.values[0].x),
        (300, 2.99, 9.8)
    );
    assert_eq!(recording.gyroscope.unwrap().values[0].z, 2.0);
}
