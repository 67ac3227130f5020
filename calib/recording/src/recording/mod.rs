//! What a device recorded, in SI units, each sensor on its own clock.
//!
//! ```text
//! file ──► source ──► header ──► rows ──┐
//!          UTF-8,     what the   tables ├─► assemble ──► Recording
//!          batches    columns    tables ┘   clock: seconds
//!          of lines   are                   units: SI
//! ```

pub(crate) mod arrays;
pub(crate) mod assemble;
pub(crate) mod checks;
pub(crate) mod decimate;
pub(crate) mod description;
pub(crate) mod magnetometer;
pub(crate) mod memory;
pub(crate) mod options;
pub(crate) mod samples;
pub(crate) mod stream;
pub(crate) mod thermometer;
pub(crate) mod write;

use std::path::Path;
use std::sync::Arc;

use sensor::Sensor;

pub use arrays::Rows;
pub use description::{Described, Description, UnitBy};
pub use magnetometer::{FieldUnit, Magnetometer};
pub use options::{ColumnMap, ReadOptions, Role};
pub use stream::{Gap, INSTANT, Stream, Temperature, is_before};
pub use write::{field_names, stream_to_csv, to_csv, to_parquet};

use crate::Error;
use crate::formats::{self, Source};
use crate::rows::table::Table;
use crate::shown::shown_path;
use crate::source::Input;
use crate::source::place::in_file;

/// One recording of one device.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// Where it came from, as the user named it.
    pub name: String,
    /// Specific force, m/s² (or raw counts).
    pub accelerometer: Option<Stream>,
    /// Angular rate, rad/s (or raw counts).
    pub gyroscope: Option<Stream>,
    /// Temperature, °C.
    pub temperature: Option<Temperature>,
    /// Magnetic field, as the file has it.
    pub magnetometer: Option<Magnetometer>,
    /// What the reader noticed and went on with.
    pub warnings: Vec<String>,
    /// Where the samples come from.
    pub description: Description,
}

impl Recording {
    /// The readings of a sensor.
    pub fn stream(&self, sensor: Sensor) -> Option<&Stream> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_ref(),
            Sensor::Gyroscope => self.gyroscope.as_ref(),
            Sensor::Magnetometer => self.magnetometer.as_ref().map(|field| &field.stream),
        }
    }

    /// The readings of a sensor, to be changed.
    pub fn stream_mut(&mut self, sensor: Sensor) -> Option<&mut Stream> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_mut(),
            Sensor::Gyroscope => self.gyroscope.as_mut(),
            Sensor::Magnetometer => self.magnetometer.as_mut().map(|field| &mut field.stream),
        }
    }

    /// The earliest time stamp, s.
    pub fn start(&self) -> f64 {
        [&self.accelerometer, &self.gyroscope]
            .into_iter()
            .flatten()
            .filter_map(|stream| stream.t.first().copied())
            .fold(f64::INFINITY, f64::min)
    }

    /// Reads the file or folder at `path`; `-` is standard input. The format is recognised from the
    /// content unless `options` name it.
    ///
    /// # Errors
    /// [`Error::Input`] for content that is no recording, beginning with `file:line:column` as far as
    /// they are known; [`Error::Io`] for a path that cannot be read; [`Error::Usage`] where an option
    /// is missing (a rate for rows without stamps) or impossible.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        options.check()?;
        Self::of_source(Source::open(path, options)?, options)
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
        let format = options.format.or_else(|| formats::recognise(&source));
        let format = format.ok_or_else(|| in_file(source.name(), "of no known format"))?;
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
        let part = formats::part_of(input.look(), sensor);
        tables.push(part.read(input, origin, options)?);
    }
    assemble::assemble(name, tables, options)
}

/// The sensor that a file is named after, so that columns called x, y, z mean something.
pub(crate) fn hint(name: &str) -> Option<Sensor> {
    let stem = name.rsplit(['/', '\\']).next()?.to_lowercase();
    match (stem.starts_with("acc"), stem.starts_with("gyr")) {
        (true, false) => Some(Sensor::Accelerometer),
        (false, true) => Some(Sensor::Gyroscope),
        _ => None,
    }
}
