//! The files beside those that a format knows by name.

use findings::{Finding, Kind};
use sensor::Sensor;

use super::known_texts::known_sensors;
use crate::Error;
use crate::header::look::Look;
use crate::header::names::role_of;
use crate::header::sniff::is_table;
use crate::recording::magnetometer;
use crate::recording::options::{ReadOptions, Role};
use crate::rows::parts;
use crate::rows::table::Table;
use crate::shown::shown;
use crate::source::files::Files;
use crate::source::place::in_file;
use crate::units::field::FieldUnit;

/// The one table among `files`, beside those `used`, that holds the sensor by its names.
pub(super) fn by_content<'a>(
    files: &'a Files,
    used: &[&str],
    sensor: Sensor,
) -> Option<&'a file_formats::Entry> {
    let holds = |head: &[u8]| {
        let look = Look::at(head);
        let axes = [0, 1, 2].map(|axis| Role::axis(sensor, axis));
        let names = look.first();
        let named = |role: &Role| names.iter().any(|name| role_of(name, None) == Some(*role));
        match known_sensors(&look) {
            Some([accel, gyro]) => [accel, gyro][usize::from(sensor == Sensor::Gyroscope)],
            None => axes.iter().all(named),
        }
    };
    let heads = files.heads().into_iter();
    let mut found = heads.filter(|(entry, head)| {
        let name = entry.name.to_lowercase();
        let other = OTHER_FILES.iter().any(|word| name.contains(word));
        !other && !used.contains(&entry.name.as_str()) && holds(head)
    });
    let first = found.next()?;
    found.next().is_none().then_some(first.0)
}

/// Adds the magnetometer of an entry that is called so, unprocessed before processed. What is wrong with it is said.
pub(super) fn add_magnetometer(
    files: &Files,
    tables: &mut Vec<Table>,
    unit: Option<FieldUnit>,
    options: &ReadOptions,
) {
    let Some(entry) = magnetometers_file(files) else {
        return;
    };
    let Some(part) = magnetometer::part(&Look::at(&files.head(entry)), unit) else {
        let unknown = Finding::of(Kind::FIELD_COLUMNS_UNKNOWN).detail("file", shown(&entry.name));
        return parts::without_field(tables, &Error::input(unknown));
    };
    let origin = tables.first().and_then(|table| table.clock.origin);
    let read = files.text(entry, options);
    match read.and_then(|text| part.read(text, origin, options)) {
        Ok(table) => tables.push(table),
        Err(error) => parts::without_field(tables, &error),
    }
}

/// The entry that is called after a magnetometer; else the one table in whose name a word is one's, as in `rec_MAG.csv`.
fn magnetometers_file(files: &Files) -> Option<&file_formats::Entry> {
    const NAMES: [&str; 4] = ["magnetometeruncalibrated", "magnetometer", "mag", "magn"];
    const TABLES: [&str; 4] = ["csv", "txt", "tsv", "dat"];
    let name = |entry: &file_formats::Entry| {
        let name = entry.name.rsplit('/').next().unwrap_or_default();
        name.to_lowercase()
    };
    let called =
        |entry: &&file_formats::Entry, wanted: &str| name(entry).split('.').next() == Some(wanted);
    let entries = || files.entries().iter();
    let mut exact = NAMES.iter();
    if let Some(entry) = exact.find_map(|name| entries().find(|entry| called(entry, name))) {
        return Some(entry);
    }
    let mut by_word = entries().filter(|entry| {
        let name = name(entry);
        let has = |all: &[&str]| {
            name.split(|c: char| !c.is_alphanumeric())
                .any(|word| all.contains(&word))
        };
        has(&NAMES) && has(&TABLES)
    });
    by_word.next().filter(|_| by_word.next().is_none())
}

/// Words in the names of files that hold neither sensor.
const OTHER_FILES: [&str; 24] = [
    "meta",
    "annotation",
    "magnet",
    "linear",
    "gravity",
    "orient",
    "location",
    "gps",
    "pressure",
    "barometer",
    "light",
    "brightness",
    "pedometer",
    "microphone",
    "sound",
    "compass",
    "battery",
    "activity",
    "heart",
    "temperature",
    "humidity",
    "proximity",
    "camera",
    "noise",
];

/// Refuses files of which a sensor is missing and another table may hold it.
pub(super) fn refuse_unused(files: &Files, used: &[&str]) -> Result<(), Error> {
    let may_hold_a_sensor = |(entry, head): &(&file_formats::Entry, Vec<u8>)| {
        let name = entry.name.to_lowercase();
        let known = OTHER_FILES.iter().any(|word| name.contains(word))
            || used.contains(&entry.name.as_str());
        !known && is_table(head)
    };
    let Some((entry, _)) = files.heads().into_iter().find(may_hold_a_sensor) else {
        return Ok(());
    };
    let found = Finding::of(Kind::SENSOR_UNUSED).detail("table", shown(&entry.name));
    let found = match files.is_archive() {
        true => found.detail("archive", files.kind()),
        false => found,
    };
    Err(in_file(&files.name, found))
}
