//! phyphox: a file per sensor in a folder or a zip archive, each sensor on its own clock.

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::Error;
use crate::formats::format::Format;
use crate::header::look::Look;
use crate::header::names::take_apart;
use crate::recording::assemble::assemble;
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::rows::parts::Part;
use crate::rows::table::Table;
use crate::shown::shown;
use crate::source::Source;
use crate::source::files::Files;
use crate::source::place::in_file;
use crate::units::{GyroUnit, is_of_sensor};

/// An export of the app phyphox, in any of its dialects and languages.
#[derive(Debug)]
pub(crate) struct Phyphox;

/// Content of a table of phyphox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Holds {
    Sensor(Sensor),
    /// Acceleration without gravity.
    Linear,
}

/// A table of a sensor.
struct Found {
    /// The entry's name.
    name: String,
    holds: Holds,
    /// Time, x, y, z.
    columns: [String; 4],
}

impl Format for Phyphox {
    fn name(&self) -> &'static str {
        "phyphox"
    }

    fn about(&self) -> &'static str {
        "a folder or zip archive of the app phyphox: `Accelerometer.csv`, `Gyroscope.csv`, `meta/`"
    }

    fn recognises(&self, source: &Source) -> bool {
        let Source::Files(files) = source else {
            return false;
        };
        is_export(files) || !tables(files).is_empty()
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let files = crate::formats::format::files(source, self)?;
        let found = tables(&files);
        let of = |wanted: Holds| found.iter().filter(move |table| table.holds == wanted);
        let accel: Vec<_> = of(Holds::Sensor(Sensor::Accelerometer)).collect();
        let gyro: Vec<_> = of(Holds::Sensor(Sensor::Gyroscope)).collect();
        if let (true, Some(Found { name, .. })) = (accel.is_empty(), of(Holds::Linear).next()) {
            let linear = Finding::of(Kind::PHYPHOX_LINEAR).detail("file", shown(name));
            return Err(in_file(&files.name, linear));
        }
        if let Some([one, two]) = [&accel, &gyro].iter().find_map(|found| found.get(..2)) {
            return Err(files.of_one_sensor(&shown(&one.name), &shown(&two.name)));
        }
        if accel.is_empty() || gyro.is_empty() {
            let used: Vec<&str> = found.iter().map(|table| table.name.as_str()).collect();
            crate::formats::beside::refuse_unused(&files, &used)?;
        }
        let mut read: Vec<Table> = Vec::new();
        for Found {
            name,
            holds,
            columns,
        } in accel.into_iter().chain(gyro)
        {
            let (Some(entry), Holds::Sensor(sensor)) = (files.entry(name), holds) else {
                continue;
            };
            // Units as the names state them: experiments of one's own may have others.
            let part = Part {
                padded: true,
                ..Part::of(*sensor, columns.each_ref().map(String::as_str))
            };
            let origin = read.first().and_then(|table| table.clock.origin);
            read.push(part.read(files.text(entry, options)?, origin, options)?);
        }
        if read.is_empty() {
            let empty = Finding::of(Kind::PHYPHOX_EMPTY).detail("listed", files.listed());
            return Err(in_file(&files.name, empty));
        }
        crate::formats::beside::add_magnetometer(&files, &mut read, None, options);
        let warnings = count_pauses(&files, &mut read);
        let mut recording = assemble(files.name.clone(), read, options)?;
        recording.warnings.extend(files.warnings());
        recording.warnings.extend(warnings);
        Ok(recording)
    }
}

/// True for files that phyphox has written beside the tables.
fn is_export(files: &Files) -> bool {
    let is_meta = |name: &str| name.ends_with("meta/device.csv") || name.ends_with("meta/time.csv");
    files.entries().iter().any(|entry| is_meta(&entry.name))
}

/// The tables of sensors in `files`, by the units and axes that phyphox writes in every language.
fn tables(files: &Files) -> Vec<Found> {
    let own = is_export(files);
    let heads = files.heads().into_iter();
    let tables = heads.filter_map(|(entry, head)| {
        let (holds, columns) = holds(&Look::at(&head).first(), own)?;
        let name = entry.name.clone();
        Some(Found {
            name,
            holds,
            columns,
        })
    });
    tables.collect()
}

/// The sensor of a table with a time and three axes in one unit, and where they are, numbered from 1. Experiments of
/// one's `own` may have other units than phyphox itself.
fn holds(names: &[String], own: bool) -> Option<(Holds, [String; 4])> {
    let apart: Vec<(String, &str)> = names
        .iter()
        .filter_map(|name| {
            let (word, unit) = take_apart(name);
            Some((word, unit?))
        })
        .collect();
    if apart.len() != names.len() {
        return None;
    }
    let find = |axis: char, stem: &str, unit: &str| {
        apart
            .iter()
            .position(|(word, other)| *other == unit && word.strip_suffix(axis) == Some(stem))
    };
    let time = apart.iter().position(|(_, unit)| *unit == "s")?;
    let (stem, unit) = apart.iter().find_map(|(word, unit)| {
        let stem = word.strip_suffix('x')?;
        let usual = matches!(*unit, "m/s^2" | "m/s²" | "rad/s");
        (usual || (own && is_of_sensor(unit))).then_some((stem, *unit))
    })?;
    let [x, y, z] = [
        find('x', stem, unit)?,
        find('y', stem, unit)?,
        find('z', stem, unit)?,
    ];
    let holds = match unit {
        _ if unit.parse::<GyroUnit>().is_ok() => Holds::Sensor(Sensor::Gyroscope),
        _ if stem.contains("linear") || stem.contains("withoutg") => Holds::Linear,
        _ => Holds::Sensor(Sensor::Accelerometer),
    };
    Some((holds, [time, x, y, z].map(|at| (at + 1).to_string())))
}

/// Experiment time stands still in a pause: stamps after one are moved on by its length.
fn count_pauses(files: &Files, tables: &mut [Table]) -> Vec<Finding> {
    let is_times = |name: &str| name.ends_with("meta/time.csv");
    let entry = files.entries().iter().find(|entry| is_times(&entry.name));
    let Some(entry) = entry else {
        return Vec::new();
    };
    let head = files.head(entry);
    let mut paused: Option<[f64; 2]> = None;
    let mut pauses: Vec<[f64; 2]> = Vec::new();
    for line in Look::at(&head).lines() {
        let cells = crate::header::look::cells(line);
        let number = |at: usize| {
            let cell: &String = cells.get(at)?;
            cell.replace(',', ".")
                .parse::<f64>()
                .ok()
                .filter(|v| v.is_finite())
        };
        let (Some(experiment), Some(system)) = (number(1), number(2)) else {
            continue;
        };
        match (cells[0].as_str(), paused.take()) {
            ("PAUSE", _) => paused = Some([experiment, system]),
            ("START", Some([at, since])) if system > since => pauses.push([at, system - since]),
            _ => {}
        }
    }
    for table in tables.iter_mut() {
        for t in table.stamps_mut().into_iter().flatten() {
            let before = pauses.iter().filter(|[at, _]| *t > *at);
            *t += before.map(|[_, length]| length).sum::<f64>();
        }
    }
    let found = |[at, length]: [f64; 2]| {
        Finding::of(Kind::PAUSED)
            .in_recording(&files.name)
            .from_time(at)
            .number("length", length, "s")
    };
    pauses.into_iter().map(found).collect()
}
