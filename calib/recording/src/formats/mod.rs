//! The formats that recordings come in: one file and one line in [`FORMATS`] each.

mod brackets;
mod bundle;
mod clock_text;
mod csv;
mod date_and_time;
mod folder;
mod imu_tk;
mod long;
mod measured;
mod phones;
mod robots;
mod tables;
mod tagged;
mod texts;
mod wide;

use std::fmt;

use phones::{androsensor, phyphox, physics_toolbox, sensor_logger, sensorlog};
use robots::{kalibr, px4_text, ros_text, serial, trackers};

pub use file_formats::catches_panics;
use sensor::Sensor;

use crate::Error;
use crate::header::look::Look;
use crate::header::names::role_of;
use crate::header::parts::{self, Part};
use crate::recording::options::Role;
use crate::recording::{FieldUnit, ReadOptions, Recording, magnetometer};
use crate::rows::table::Table;
use crate::shown::shown;
use crate::source::Input;
pub use crate::source::Source;
use crate::source::files::Files;
use crate::source::place::in_file;

/// A format of recordings.
pub trait Format: fmt::Debug + Sync {
    /// The name for `--format`.
    fn name(&self) -> &'static str;

    /// What it is, in a line.
    fn about(&self) -> &'static str;

    /// True if the content is of this format. The first format of [`FORMATS`] that says so reads it.
    fn recognises(&self, source: &Source) -> bool;

    /// Reads all of it.
    ///
    /// # Errors
    /// [`Error::Input`] naming the place, what was found and what to do.
    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error>;
}

/// Every format.
pub static FORMATS: &[&dyn Format] = &[
    &tables::Tables("json"),
    &tables::Tables("parquet"),
    &tables::Tables("hdf5"),
    &tables::Tables("xlsx"),
    &phyphox::Phyphox,
    &sensor_logger::SensorLogger,
    &folder::Folder,
    &measured::Measured("mat"),
    &measured::Measured("ulog"),
    &measured::Measured("ardupilot"),
    &measured::Measured("mcap"),
    &measured::Measured("bag"),
    &measured::Measured("db3"),
    &measured::Measured("sensor_logger_json"),
    &bundle::Bundle,
    &physics_toolbox::PHYSICS_TOOLBOX,
    &sensorlog::SENSORLOG,
    &androsensor::ANDROSENSOR,
    &ros_text::ROSTOPIC,
    &ros_text::ROS2_TOPIC,
    &kalibr::KALIBR,
    &px4_text::SENSOR_COMBINED,
    &trackers::XSENS,
    &trackers::SHIMMER,
    &tagged::GET_SENSOR_DATA,
    &tagged::GNSS_LOGGER,
    &tagged::VECTORNAV,
    &wide::WIDE,
    &long::LONG,
    &serial::ADAFRUIT,
    &serial::SERIAL,
    &clock_text::TIME_OF_DAY,
    &brackets::BRACKETS,
    &date_and_time::DATE_AND_TIME,
    &imu_tk::ImuTk,
    &csv::Csv,
];

/// Tables whose names say less than their program means.
static TEXTS: [&texts::TextFormat; 11] = [
    &physics_toolbox::PHYSICS_TOOLBOX,
    &sensorlog::SENSORLOG,
    &androsensor::ANDROSENSOR,
    &ros_text::ROSTOPIC,
    &kalibr::KALIBR,
    &px4_text::SENSOR_COMBINED,
    &trackers::XSENS,
    &trackers::SHIMMER,
    &clock_text::TIME_OF_DAY,
    &brackets::BRACKETS,
    &date_and_time::DATE_AND_TIME,
];

/// How to read one sensor of a text: as its program means it, else by its names.
pub(crate) fn part_of(look: &Look, sensor: Sensor) -> Part {
    let mut parts = TEXTS.iter().filter_map(|text| (text.parts)(look)).flatten();
    let known = parts.find(|part| part.may_hold(sensor));
    known.unwrap_or_default().narrowed(sensor)
}

/// Which of accelerometer and gyroscope a text holds as its program means it; `None` for tables that are read by names.
pub(crate) fn known_sensors(look: &Look) -> Option<[bool; 2]> {
    let mut texts = TEXTS.iter().filter_map(|text| (text.parts)(look));
    let parts = texts.find(|parts| parts.iter().any(|part| !part.columns.is_empty()))?;
    let has = |sensor| parts.iter().any(|part: &Part| part.has(sensor));
    Some([has(Sensor::Accelerometer), has(Sensor::Gyroscope)])
}

/// The one table among `files`, beside those `used`, that holds the sensor by its names.
fn by_content<'a>(
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

/// The format called `name`.
///
/// # Errors
/// The names there are.
pub fn by_name(name: &str) -> Result<&'static dyn Format, String> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.name() == name)
        .ok_or_else(|| {
            let names: Vec<_> = FORMATS.iter().map(|format| format.name()).collect();
            format!("no format `{name}`; known: {}", names.join(", "))
        })
}

/// The format of `source`.
pub(crate) fn recognise(source: &Source) -> Option<&'static dyn Format> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.recognises(source))
}

/// The text in `source`; anything else is refused by name of the format.
fn text(source: Source, format: &dyn Format) -> Result<Input, Error> {
    match source.within() {
        Source::Text(input) => Ok(input),
        other => Err(mismatch(other.name(), format, "a file of text")),
    }
}

/// The files in `source`; anything else is refused by name of the format.
fn files(source: Source, format: &dyn Format) -> Result<Files, Error> {
    match source.within() {
        Source::Files(files) => Ok(files),
        other => Err(mismatch(other.name(), format, "a folder or an archive")),
    }
}

fn mismatch(name: &str, format: &dyn Format, expected: &str) -> Error {
    Error::Usage(format!(
        "{name}: --format {} reads {expected}, and this is none",
        format.name()
    ))
}

/// Adds the magnetometer of an entry that is called so, unprocessed before processed. What is wrong with it is said.
fn add_magnetometer(
    files: &Files,
    tables: &mut Vec<Table>,
    unit: Option<FieldUnit>,
    options: &ReadOptions,
) {
    const NAMES: [&str; 4] = ["magnetometeruncalibrated", "magnetometer", "mag", "magn"];
    let called = |entry: &&file_formats::Entry, wanted: &str| {
        let name = entry.name.rsplit('/').next().unwrap_or_default();
        name.to_lowercase().split('.').next() == Some(wanted)
    };
    let entries = || files.entries().iter();
    let entry = NAMES
        .iter()
        .find_map(|name| entries().find(|entry| called(entry, name)));
    let Some((entry, part)) = entry.and_then(|entry| {
        let part = magnetometer::part(&Look::at(&files.head(entry)), unit)?;
        Some((entry, part))
    }) else {
        return;
    };
    let origin = tables.first().and_then(|table| table.clock.origin);
    let read = files.text(entry, options);
    match read.and_then(|text| part.read(text, origin, options)) {
        Ok(table) => tables.push(table),
        Err(error) => parts::without_field(tables, &error),
    }
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
fn refuse_unused(files: &Files, used: &[&str]) -> Result<(), Error> {
    let is_table = |(entry, head): &(&file_formats::Entry, Vec<u8>)| {
        let name = entry.name.to_lowercase();
        let known = OTHER_FILES.iter().any(|word| name.contains(word))
            || used.contains(&entry.name.as_str());
        !known && crate::header::sniff::is_table(head)
    };
    let Some((entry, _)) = files.heads().into_iter().find(is_table) else {
        return Ok(());
    };
    let unpack = match files.is_archive() {
        true => "unpack it and ",
        false => "",
    };
    Err(in_file(
        &files.name,
        format!(
            "one sensor is missing, and {} is a table that is not used and may hold it; {unpack}name the two files with --accel-file and --gyro-file, or the one there is by itself",
            shown(&entry.name)
        ),
    ))
}
