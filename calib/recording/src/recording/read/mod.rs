//! From a file, a folder, bytes or a pair of files to a recording.

mod given_rate;

use std::path::Path;
use std::sync::Arc;

use findings::{Finding, Kind};
use sensor::Sensor;

use super::assemble;
use super::content::Recording;
use super::options::ReadOptions;
use crate::Error;
use crate::formats;
use crate::rows::table::Table;
use crate::shown::shown_path;
use crate::source::place::in_file;
use crate::source::{Input, Source};

impl Recording {
    /// Reads the file or folder at `path`; `-` is standard input. The format is recognised from the
    /// content unless `options` name it.
    ///
    /// # Errors
    /// [`Error::Input`] for content that is no recording, beginning with `file:line:column` as far as
    /// they are known; [`Error::Io`] for a path that cannot be read; [`Error::Usage`] where an option
    /// is missing (a rate for rows without stamps) or impossible.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        options.check()?;
        let mut recording = Self::of_source(Source::open(path, options)?, options)?;
        let contradicted = given_rate::contradicted(path, options, &recording);
        recording.warnings.extend(contradicted);
        Ok(recording)
    }

    /// Reads all recordings of the file or folder at `path`: several where its clock begins again, as after a reboot, or
    /// where two logs were joined. They are called `name#1`, `name#2`, and are those of one device.
    ///
    /// # Errors
    /// As [`Recording::read`]; [`Error::Parts`] for several on standard input, which cannot be read again.
    pub fn read_all(path: &Path, options: &ReadOptions) -> Result<Vec<Self>, Error> {
        match Self::read(path, options) {
            Err(Error::Parts { count, .. })
                if path.as_os_str() != "-" && options.part.is_none() =>
            {
                let name = shown_path(path);
                each_part(count, &name, options, |o| Self::read(path, o))
            }
            one => one.map(|recording| vec![recording]),
        }
    }

    /// All recordings of one file per sensor, as [`Recording::read_all`] has those of one.
    ///
    /// # Errors
    /// As [`Recording::read`].
    pub fn read_pair_all(
        accel: &Path,
        gyro: &Path,
        options: &ReadOptions,
    ) -> Result<Vec<Self>, Error> {
        match Self::read_pair(accel, gyro, options) {
            Err(Error::Parts { count, .. }) if options.part.is_none() => {
                let name = shown_path(accel);
                each_part(count, &name, options, |o| Self::read_pair(accel, gyro, o))
            }
            one => one.map(|recording| vec![recording]),
        }
    }

    /// Reads a file that is in memory; `name` is what messages call it.
    ///
    /// # Errors
    /// As [`Recording::read`].
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::{Error, Recording};
    ///
    /// let text = "t,ax,ay,az\n0.00,0.1,0.2,9.8\n0.01,0.1,0.3,9.7\n";
    /// let recording = Recording::from_bytes("session.csv", text.as_bytes(), &Default::default())?;
    /// assert_eq!(recording.accelerometer.map(|stream| stream.len()), Some(2));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn from_bytes(
        name: &str,
        bytes: impl Into<Arc<[u8]>>,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        options.check()?;
        Self::of_source(Source::of_bytes(name, bytes.into(), options)?, options)
    }

    fn of_source(source: Source, options: &ReadOptions) -> Result<Self, Error> {
        refuse_choice(&source, options)?;
        let files = source.files().cloned();
        let read = Self::of_format(source, options);
        // What was not read may be what is missing, or beside what was found.
        if let Some(files) = files {
            files.refuse_unread()?;
        }
        read
    }

    fn of_format(source: Source, options: &ReadOptions) -> Result<Self, Error> {
        let format = match options.format {
            Some(name) => Some(formats::by_name(name).map_err(Error::usage)?),
            None => formats::recognise(&source),
        };
        let format =
            format.ok_or_else(|| in_file(source.name(), Finding::of(Kind::UNKNOWN_FORMAT)))?;
        let mut recording = format.read(source, options)?;
        let described = &mut recording.description.format;
        if described.is_empty() {
            *described = format.name();
        }
        Ok(recording)
    }

    /// Reads one file per sensor, both on one clock: `t x y z` without a header in any unit, or any
    /// text that [`Recording::read`] reads.
    ///
    /// # Errors
    /// As [`Recording::read`].
    pub fn read_pair(accel: &Path, gyro: &Path, options: &ReadOptions) -> Result<Self, Error> {
        options.check()?;
        let name = format!("{} + {}", shown_path(accel), shown_path(gyro));
        pair(
            name,
            &[(accel, Sensor::Accelerometer), (gyro, Sensor::Gyroscope)],
            options,
        )
    }
}

/// Refuses options that choose among what a file of this kind holds only one of.
fn refuse_choice(source: &Source, options: &ReadOptions) -> Result<(), Error> {
    let (has_entry, has_topic) = (options.entry.is_some(), !options.topics.is_empty());
    let kind = match source {
        Source::Text(_) | Source::Binary(_) if has_entry => Kind::ENTRY_OF_ONE_FILE,
        Source::Text(_) if has_topic => Kind::TOPIC_OF_TEXT,
        _ => return Ok(()),
    };
    Err(Error::usage(Finding::of(kind).in_file(source.name())))
}

/// The recordings of a file one by one, the first of which says that there are several.
fn each_part(
    count: usize,
    name: &str,
    options: &ReadOptions,
    read: impl Fn(&ReadOptions) -> Result<Recording, Error>,
) -> Result<Vec<Recording>, Error> {
    let part = |part| {
        read(&ReadOptions {
            part: Some(part),
            ..options.clone()
        })
    };
    let mut all: Vec<Recording> = (1..=count).map(part).collect::<Result<_, _>>()?;
    let names: Vec<String> = all.iter().map(|recording| recording.name.clone()).collect();
    let said = match all.len() {
        2 => names.join(" and "),
        _ => format!("{name}#1 to {name}#{count}"),
    };
    if let Some(first) = all.first_mut() {
        first.warnings.push_first(
            Finding::of(Kind::SEVERAL_RECORDINGS)
                .in_recording(name)
                .count("count", count)
                .detail("names", said),
        );
    }
    Ok(all)
}

/// A recording of one file per sensor.
fn pair(
    name: String,
    files: &[(&Path, Sensor)],
    options: &ReadOptions,
) -> Result<Recording, Error> {
    let mut tables: Vec<Table> = Vec::new();
    for &(path, sensor) in files {
        let origin = tables.first().and_then(|table| table.clock.origin);
        let input = Input::open(path, options)?;
        let part = formats::known_texts::part_of(input.look(), sensor);
        tables.push(part.read(input, origin, options)?);
    }
    assemble::assemble(name, tables, options)
}
