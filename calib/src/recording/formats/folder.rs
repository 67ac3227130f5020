//! A folder with a file per sensor.

use std::path::{Path, PathBuf};

use sensor::Sensor;

use super::{Format, Source};
use crate::Error;
use crate::recording::place::{in_file, shown, shown_path};
use crate::recording::source::explained;
use crate::recording::{ReadOptions, Recording, pair};

/// `acc.csv` and `gyro.csv`, each sensor on its own clock.
#[derive(Debug)]
pub(super) struct Folder;

const ACCEL: [&str; 3] = ["acc", "accel", "accelerometer"];
const GYRO: [&str; 3] = ["gyro", "gyr", "gyroscope"];
const EXTENSIONS: [&str; 4] = ["csv", "txt", "tsv", "dat"];

impl Format for Folder {
    fn name(&self) -> &'static str {
        "folder"
    }

    fn about(&self) -> &'static str {
        "a folder with acc.csv (t,ax,ay,az) and gyro.csv (t,gx,gy,gz), t on one clock"
    }

    fn recognises(&self, source: &Source<'_>) -> bool {
        matches!(source, Source::Folder(_))
    }

    fn read(&self, source: Source<'_>, options: &ReadOptions) -> Result<Recording, Error> {
        let Source::Folder(folder) = source else {
            return Err(Error::Usage(
                "--format folder: the recording is no folder".to_owned(),
            ));
        };
        let files = files(folder)?;
        let accel = choose(folder, &files, &ACCEL)?;
        let gyro = choose(folder, &files, &GYRO)?;
        let sensors = [(accel, Sensor::Accelerometer), (gyro, Sensor::Gyroscope)];
        let present = sensors
            .iter()
            .filter_map(|(path, sensor)| Some((path.as_deref()?, *sensor)));
        let present: Vec<_> = present.collect();
        if present.is_empty() {
            return Err(nothing(folder, &files));
        }
        pair(shown_path(folder), &present, options)
    }
}

/// The names in a folder, in order.
fn files(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = std::fs::read_dir(folder).map_err(|error| explained(folder, error))?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    Ok(files)
}

/// The one file called after a sensor.
fn choose(folder: &Path, files: &[PathBuf], names: &[&str]) -> Result<Option<PathBuf>, Error> {
    let mut named = files.iter().filter(|path| is_called(path, names));
    match (named.next(), named.next()) {
        (Some(one), Some(two)) => Err(in_file(
            &shown_path(folder),
            format!(
                "{} and {} are of one sensor; name the two files with --accel-file and --gyro-file",
                shown_path(one),
                shown_path(two)
            ),
        )),
        (one, _) => Ok(one.cloned()),
    }
}

/// True for `acc.csv`, `Accelerometer.txt`, `acc.csv.gz` and the like.
fn is_called(path: &Path, names: &[&str]) -> bool {
    let Some(name) = path
        .file_name()
        .map(|name| name.to_string_lossy().to_lowercase())
    else {
        return false;
    };
    let name = name.trim_end_matches(".gz").trim_end_matches(".zst");
    let Some((stem, extension)) = name.split_once('.') else {
        return false;
    };
    names.contains(&stem) && EXTENSIONS.contains(&extension)
}

fn nothing(folder: &Path, files: &[PathBuf]) -> Error {
    let names: Vec<_> = files
        .iter()
        .take(10)
        .filter_map(|f| f.file_name())
        .collect();
    let names: Vec<_> = names
        .iter()
        .map(|name| shown(&name.to_string_lossy()))
        .collect();
    let found = if names.is_empty() {
        "nothing".to_owned()
    } else {
        names.join(", ")
    };
    in_file(
        &shown_path(folder),
        format!(
            "neither acc.csv (t,ax,ay,az) nor gyro.csv (t,gx,gy,gz) in this folder; found {found}"
        ),
    )
}
