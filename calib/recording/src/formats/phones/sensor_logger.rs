//! Sensor Logger: a file per sensor, some with gravity and some without, and a file of what was set.

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::Error;
use crate::formats::format::Format;
use crate::header::look::{Look, cells};
use crate::recording::assemble::assemble;
use crate::recording::{ReadOptions, Recording, with_gravity};
use crate::rows::parts::Part;
use crate::rows::table::Table;
use crate::source::Source;
use crate::source::files::Files;
use crate::source::place::in_file;
use crate::units::field::FieldUnit;

/// An export of the app Sensor Logger as a folder or a zip archive.
#[derive(Debug)]
pub(crate) struct SensorLogger;

/// Files of an accelerometer with gravity, and of a gyroscope: unprocessed before processed.
const ACCEL: [&str; 2] = ["AccelerometerUncalibrated", "TotalAcceleration"];
const GYRO: [&str; 2] = ["GyroscopeUncalibrated", "Gyroscope"];
/// Names in the app of the streams of an accelerometer with gravity.
const WITH_GRAVITY: [&str; 2] = ["Total Acceleration", "Accelerometer (Uncalibrated)"];
/// Files that make an accelerometer with gravity together.
const PARTS: [&str; 2] = ["Accelerometer", "Gravity"];

impl Format for SensorLogger {
    fn name(&self) -> &'static str {
        "sensor_logger"
    }

    fn about(&self) -> &'static str {
        "a folder or zip archive of the app Sensor Logger: `TotalAcceleration.csv`, `Gyroscope.csv`, `Metadata.csv`"
    }

    fn recognises(&self, source: &Source) -> bool {
        let Source::Files(files) = source else {
            return false;
        };
        let named = ACCEL.iter().chain(&GYRO).chain(&PARTS);
        let mut named = named.filter_map(|name| find(files, name));
        named.any(|entry| {
            let names = Look::at(&files.head(entry)).first();
            names.iter().any(|name| name == "seconds_elapsed")
        })
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let files = crate::formats::format::files(source, self)?;
        let settings = Settings::of(&files);
        let reader = Reader {
            files: &files,
            options,
            negated: settings.ios && !settings.standardised,
        };
        let mut tables: Vec<Table> = Vec::new();
        let mut taken = Vec::new();
        match ACCEL.iter().find(|name| find(&files, name).is_some()) {
            Some(name) => {
                tables.push(reader.table(name, Sensor::Accelerometer, None)?);
                taken.push((*name).to_owned());
            }
            None if PARTS.iter().all(|name| find(&files, name).is_some()) => {
                tables.push(reader.sum()?);
                taken.push(PARTS.join(" + "));
            }
            None if find(&files, PARTS[0]).is_some() => return Err(without_gravity(&files)),
            None => {}
        }
        if let Some(name) = GYRO.iter().find(|name| find(&files, name).is_some()) {
            let origin = tables.first().and_then(|table| table.clock.origin);
            tables.push(reader.table(name, Sensor::Gyroscope, origin)?);
            taken.push((*name).to_owned());
        }
        if tables.len() == 1 {
            let used: Vec<&str> = files
                .entries()
                .iter()
                .map(|entry| entry.name.as_str())
                .filter(|name| {
                    let known = ACCEL.iter().chain(&GYRO).chain(&PARTS);
                    known
                        .into_iter()
                        .any(|stem| name.ends_with(&format!("{stem}.csv")))
                })
                .collect();
            crate::formats::beside::refuse_unused(&files, &used)?;
        }
        let microtesla = Some(FieldUnit::Microtesla);
        crate::formats::beside::add_magnetometer(&files, &mut tables, microtesla, options);
        let mut recording = assemble(files.name.clone(), tables, options)?;
        recording.warnings.extend(files.warnings());
        let of = |kind: Kind| {
            Finding::of(kind)
                .in_recording(&files.name)
                .detail("system", "Sensor Logger")
        };
        let streams = taken.join(" and ");
        let chosen = of(Kind::STREAMS_CHOSEN).detail("streams", streams);
        recording.warnings.push(chosen);
        if reader.negated {
            recording.warnings.push(of(Kind::SIGN_TURNED));
        }
        Ok(recording)
    }
}

/// The entry of the sensor called `name`, in whatever folder of the archive.
fn find<'a>(files: &'a Files, name: &str) -> Option<&'a file_formats::Entry> {
    let is_called = |entry: &&file_formats::Entry| {
        let file = entry.name.rsplit('/').next().unwrap_or_default();
        file.strip_suffix(".csv") == Some(name)
    };
    files.entries().iter().find(is_called)
}

fn without_gravity(files: &Files) -> Error {
    in_file(&files.name, Finding::of(Kind::SENSOR_LOGGER_LINEAR))
}

/// Settings of the app.
struct Settings {
    ios: bool,
    standardised: bool,
}

impl Settings {
    fn of(files: &Files) -> Self {
        let mut settings = Self {
            ios: false,
            standardised: false,
        };
        let Some(entry) = find(files, "Metadata") else {
            return settings;
        };
        let head = files.head(entry);
        let look = Look::at(&head);
        let rows: Vec<Vec<String>> = look.lines().take(2).map(cells).collect();
        let [names, values] = &rows[..] else {
            return settings;
        };
        for (name, value) in names.iter().zip(values) {
            let value = value.to_lowercase();
            match name.as_str() {
                "platform" => settings.ios = value == "ios",
                "standardisation" => settings.standardised = value == "true",
                _ => {}
            }
        }
        settings
    }
}

struct Reader<'a> {
    files: &'a Files,
    options: &'a ReadOptions,
    negated: bool,
}

impl Reader<'_> {
    fn table(&self, name: &str, sensor: Sensor, origin: Option<i64>) -> Result<Table, Error> {
        let missing = || self.files.no_entry(&format!("{name}.csv"));
        let entry = find(self.files, name).ok_or_else(missing)?;
        let part = Part {
            negated: self.negated && sensor == Sensor::Accelerometer,
            ..Part::of(sensor, ["time", "x", "y", "z"])
        };
        part.read(self.files.text(entry, self.options)?, origin, self.options)
    }

    /// The accelerometer with gravity, as the sum of what the system takes apart.
    fn sum(&self) -> Result<Table, Error> {
        let mut linear = self.table(PARTS[0], Sensor::Accelerometer, None)?;
        let gravity = self.table(PARTS[1], Sensor::Accelerometer, linear.clock.origin)?;
        let sum = with_gravity::sum(&linear.accel, &gravity.accel);
        let streams = WITH_GRAVITY
            .map(|stream| format!("\"{stream}\""))
            .join(" or ");
        let sum = sum.map_err(|found| {
            let found = found.detail("streams", streams);
            in_file(&self.files.name, found)
        })?;
        linear.accel = sum;
        Ok(linear)
    }
}
