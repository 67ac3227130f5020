//! A folder with a file per sensor.

use file_formats::Entry;
use sensor::Sensor;

use crate::Error;
use crate::formats::format::Format;
use crate::header::look::Look;
use crate::recording::assemble::assemble;
use crate::recording::{ReadOptions, Recording, thermometer};
use crate::rows::table::Table;
use crate::source::Source;
use crate::source::files::Files;

/// `acc.csv` and `gyro.csv`, each sensor with stamps of its own, and `temp.csv`.
#[derive(Debug)]
pub(crate) struct Folder;

const ACCEL: [&str; 5] = ["acc", "acce", "accl", "accel", "accelerometer"];
const GYRO: [&str; 3] = ["gyro", "gyr", "gyroscope"];
const THERMOMETER: [&str; 3] = ["temp", "temperature", "thermometer"];
const EXTENSIONS: [&str; 6] = ["csv", "txt", "tsv", "dat", "parquet", "json"];

impl Format for Folder {
    fn name(&self) -> &'static str {
        "folder"
    }

    fn about(&self) -> &'static str {
        "a folder with acc.csv (t,ax,ay,az), gyro.csv (t,gx,gy,gz) and, if any, temp.csv (t,temp), t on one clock"
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Files(files) if sensors(files).map_or(true, |found| !found.is_empty()))
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let files = crate::formats::format::files(source, self)?;
        let mut tables: Vec<Table> = Vec::new();
        let mut sensors = sensors(&files)?;
        if let [(entry, sensor)] = sensors[..] {
            let missing = match sensor {
                Sensor::Gyroscope => Sensor::Accelerometer,
                _ => Sensor::Gyroscope,
            };
            match crate::formats::beside::by_content(&files, &[&entry.name], missing) {
                Some(other) => sensors.push((other, missing)),
                None => crate::formats::beside::refuse_unused(&files, &[&entry.name])?,
            }
        }
        for (entry, sensor) in sensors {
            let input = files.text(entry, options)?;
            let part = crate::formats::known_texts::part_of(input.look(), sensor);
            let origin = tables.first().and_then(|table| table.clock.origin);
            tables.push(part.read(input, origin, options)?);
        }
        if tables.is_empty() {
            return Err(files.without_recording());
        }
        crate::formats::beside::add_magnetometer(&files, &mut tables, None, options);
        add_thermometer(&files, &mut tables, options)?;
        let mut recording = assemble(files.name.clone(), tables, options)?;
        recording.warnings.extend(files.warnings());
        Ok(recording)
    }
}

/// The files that are called after a sensor, with the sensor.
fn sensors(files: &Files) -> Result<Vec<(&Entry, Sensor)>, Error> {
    let accel = choose(files, &ACCEL)?.map(|entry| (entry, Sensor::Accelerometer));
    let gyro = choose(files, &GYRO)?.map(|entry| (entry, Sensor::Gyroscope));
    if accel.is_none()
        && gyro.is_none()
        && let Some(pair) = by_words(files)
    {
        return Ok(pair.to_vec());
    }
    Ok(accel.into_iter().chain(gyro).collect())
}

/// Adds the temperature of a file that is called so; the sensors' files may hold one of their own.
fn add_thermometer(
    files: &Files,
    tables: &mut Vec<Table>,
    options: &ReadOptions,
) -> Result<(), Error> {
    let known = tables.iter().any(|table| !table.temperature.is_empty());
    let entry = choose(files, &THERMOMETER)?.filter(|_| !known);
    let columns = entry.and_then(|entry| thermometer::columns(&Look::at(&files.head(entry))));
    if let Some((entry, columns)) = entry.zip(columns) {
        let origin = tables.first().and_then(|table| table.clock.origin);
        let options = ReadOptions {
            columns,
            ..options.clone()
        };
        let text = files.text(entry, &options)?;
        tables.push(Table::read(text, None, origin, &options)?);
    }
    Ok(())
}

/// The words of a name in small letters: those of `RawAccel.csv` are `raw`, `accel` and `csv`.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_small = false;
    for c in name.chars() {
        let begins = !c.is_alphabetic() || (was_small && c.is_uppercase());
        if begins {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| c.is_alphabetic()) {
            word.extend(c.to_lowercase());
        }
        was_small = c.is_lowercase();
    }
    words
}

/// The two files in whose names a word is a sensor's, as in `Sensor1_2026_Accelerometer_100Hz.csv` and `VID_20261121accel.csv`;
/// or tables of a document, as `streams/ACCL/samples`.
fn by_words(files: &Files) -> Option<[(&Entry, Sensor); 2]> {
    const DERIVED: [&str; 4] = ["linear", "gravity", "user", "free"];
    let only = |names: &[&str]| {
        let mut called = files.entries().iter().filter(|entry| {
            let name = match files.are_tables() {
                true => &entry.name,
                false => entry.name.rsplit('/').next().unwrap_or_default(),
            };
            let words = words(name);
            let has = |all: &[&str]| words.iter().any(|word| all.contains(&word.as_str()));
            has(names) && (has(&EXTENSIONS) || files.are_tables()) && !has(&DERIVED)
        });
        called.next().filter(|_| called.next().is_none())
    };
    let (accel, gyro) = (only(&ACCEL)?, only(&GYRO)?);
    // One file of both is another format's.
    (accel.name != gyro.name).then_some([(accel, Sensor::Accelerometer), (gyro, Sensor::Gyroscope)])
}

/// The one file called after a sensor.
fn choose<'a>(files: &'a Files, names: &[&str]) -> Result<Option<&'a Entry>, Error> {
    let mut named = files
        .entries()
        .iter()
        .filter(|entry| is_called(&entry.name, names, files.are_tables()));
    match (named.next(), named.next()) {
        (Some(one), Some(two)) => Err(files.of_one_sensor(&files.called(one), &files.called(two))),
        (one, _) => Ok(one),
    }
}

/// True for `acc.csv`, `Accelerometer.txt`, `acc.csv.gz` and the like; for `acc`, where that is a table's name.
fn is_called(path: &str, names: &[&str], is_table: bool) -> bool {
    let name = path.rsplit('/').next().unwrap_or_default().to_lowercase();
    let name = name.trim_end_matches(".gz").trim_end_matches(".zst");
    let Some((stem, extension)) = name.split_once('.') else {
        return is_table && names.contains(&name);
    };
    names.contains(&stem) && EXTENSIONS.contains(&extension)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capitals_begin_words_within_names() {
        for (name, expected) in [
            ("RawAccel.csv", "raw accel csv"),
            ("1/streams/ACCL/samples", "streams accl samples"),
            ("VID_20261121accel.csv", "vid accel csv"),
        ] {
            let words: Vec<String> = words(name).into_iter().filter(|w| !w.is_empty()).collect();
            assert_eq!(words.join(" "), expected);
        }
    }
}
