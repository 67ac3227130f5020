//! A folder or an archive with a recording in it.

use file_formats::Entry;
use findings::{Finding, Kind, OptionName, Remedy};
use sensor::Sensor;

use super::format::{Format, Recognise};
use crate::Error;
use crate::header::sniff::sensors_in;
use crate::recording::assemble::assemble;
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::rows::table::Table;
use crate::shown::shown;
use crate::source::Source;
use crate::source::files::Files;
use crate::source::place::in_file;

/// One file of a container that is a recording of its own, as of a bag of ROS 2; and what finds out how it is read.
#[derive(Debug)]
pub(crate) struct Bundle(pub Recognise);

/// An entry that is a recording, and which sensors are in it, as far as its beginning tells.
struct Found<'a> {
    entry: &'a Entry,
    /// Accelerometer, gyroscope.
    sensors: [bool; 2],
}

impl Format for Bundle {
    fn name(&self) -> &'static str {
        "bundle"
    }

    fn about(&self) -> &'static str {
        "a folder or zip archive with one recording in it, or several to choose from"
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Files(_))
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let files = crate::formats::format::files(source, self)?;
        let entry = match &options.entry {
            Some(name) => files.entry(name).ok_or_else(|| files.no_entry(name))?,
            None => {
                let found = recordings(&files, options);
                if let Some(pair) = pair(&found) {
                    return read_pair(&files, pair, options);
                }
                only(&files, &found)?
            }
        };
        let source = files.source(entry, options)?;
        let format = (self.0)(&source)
            .ok_or_else(|| in_file(&files.called(entry), Finding::of(Kind::UNKNOWN_FORMAT)))?;
        let mut recording = format.read(source, options)?;
        let whole = recording.accelerometer.is_some() && recording.gyroscope.is_some();
        if !whole && options.entry.is_none() && options.columns.0.is_empty() {
            crate::formats::beside::refuse_unused(&files, &[&entry.name])?;
        }
        recording.description.format = format.name();
        recording.warnings.extend(files.warnings());
        Ok(recording)
    }
}

/// The entries that are recordings; tables of other quantities only where there is nothing else.
fn recordings<'a>(files: &'a Files, options: &ReadOptions) -> Vec<Found<'a>> {
    let found = files.entries().iter().filter_map(|entry| {
        let source = files.source(entry, options).ok()?;
        let (known, sensors) = match &source {
            Source::Text(input) => {
                let known = crate::formats::known_texts::known_sensors(input.look());
                let by_names = || sensors_in(&input.name, &input.head, options);
                (known.is_some(), known.unwrap_or_else(by_names))
            }
            _ => (false, [true, true]),
        };
        (known || source.holds_samples(options)).then_some(Found { entry, sensors })
    });
    let found: Vec<Found<'_>> = found.take(20).collect();
    let (of_sensors, others): (Vec<_>, Vec<_>) = found
        .into_iter()
        .partition(|found| found.sensors != [false, false]);
    match of_sensors.is_empty() {
        true => others,
        false => of_sensors,
    }
}

/// The two entries that hold a sensor each, where no other holds either.
fn pair<'a>(found: &[Found<'a>]) -> Option<[(&'a Entry, Sensor); 2]> {
    match found {
        [a, b] if a.sensors == [true, false] && b.sensors == [false, true] => Some([
            (a.entry, Sensor::Accelerometer),
            (b.entry, Sensor::Gyroscope),
        ]),
        [a, b] if a.sensors == [false, true] && b.sensors == [true, false] => Some([
            (b.entry, Sensor::Accelerometer),
            (a.entry, Sensor::Gyroscope),
        ]),
        _ => None,
    }
}

fn read_pair(
    files: &Files,
    pair: [(&Entry, Sensor); 2],
    options: &ReadOptions,
) -> Result<Recording, Error> {
    let mut tables: Vec<Table> = Vec::new();
    for (entry, sensor) in pair {
        let input = files.text(entry, options)?;
        let part = crate::formats::known_texts::part_of(input.look(), sensor);
        let origin = tables.first().and_then(|table| table.clock.origin);
        tables.push(part.read(input, origin, options)?);
    }
    crate::formats::beside::add_magnetometer(files, &mut tables, None, options);
    let mut recording = assemble(files.name.clone(), tables, options)?;
    recording.warnings.extend(files.warnings());
    Ok(recording)
}

/// The one entry that is a recording; beside it there may be what programs work out of it.
fn only<'a>(files: &Files, found: &[Found<'a>]) -> Result<&'a Entry, Error> {
    let is_worked_out = |found: &&Found<'_>| {
        let name = found.entry.name.to_lowercase();
        let name = name.rsplit('/').next().unwrap_or_default();
        found.sensors == [true, false]
            && ["linear", "earth", "gravity", "useracc", "freeacc"]
                .iter()
                .any(|word| name.contains(word))
    };
    let whole: Vec<&Found<'_>> = found.iter().filter(|f| f.sensors == [true, true]).collect();
    match (found, &whole[..]) {
        ([one], _) => Ok(one.entry),
        ([], _) => Err(files.without_recording()),
        (_, [one]) if found.iter().filter(|f| !is_worked_out(f)).count() == 1 => Ok(one.entry),
        ([first, ..], _) => {
            let names: Vec<_> = found.iter().map(|f| shown(&f.entry.name)).collect();
            // What holds both sensors is most likely meant.
            let likely = whole.first().map_or(first, |whole| whole);
            Err(in_file(
                &files.name,
                Finding::of(Kind::ENTRY_OPEN)
                    .count("count", names.len())
                    .detail("listed", names.join(", "))
                    .only_remedies([Remedy::such_as(
                        OptionName::Entry,
                        shown(&likely.entry.name),
                    )]),
            ))
        }
    }
}
