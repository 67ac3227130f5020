//! Recordings as plain CSV or Parquet.

mod folder;
mod stamp;

use findings::{Finding, Kind};
use sensor::Sensor;
use std::fmt::Write as _;

use file_formats::write_parquet;

use self::stamp::FileStamp;
use super::{Magnetometer, Recording, Stream, Temperature};
use crate::Error;

pub use folder::{FOLDER_FILES, FolderFile};

/// The recording as one plain CSV table, numbers to their last digit, stamps on the clock of the file that it is from.
///
/// Where the sensors have clocks of their own the gyroscope is interpolated to the stamps of the
/// accelerometer that lie within its own; a warning is added that says so. The temperature is that at each stamp, and a
/// magnetometer alone keeps its stamps. Sensors of one dimension have no column.
pub fn to_csv(recording: &mut Recording) -> String {
    let plain = Plain::of(recording);
    let mut text = plain.names.join(",") + "\n";
    // Writing to a string does not fail.
    for row in 0..plain.rows() {
        let _ = write!(text, "{}", plain.stamp(row));
        plain.cells(row, |cell| {
            text.push(',');
            if let Some(number) = cell {
                let _ = write!(text, "{number}");
            }
        });
        text.push('\n');
    }
    text
}

/// The same table as a Parquet file.
///
/// # Errors
/// [`Error::Usage`] in a build without the feature `parquet`.
pub fn to_parquet(recording: &mut Recording) -> Result<Vec<u8>, Error> {
    let plain = Plain::of(recording);
    let rows = plain.rows();
    let column = |name: &String| (name.clone(), Vec::with_capacity(rows));
    let mut columns: Vec<(String, Vec<f64>)> = plain.names.iter().map(column).collect();
    for row in 0..rows {
        let mut column = columns.iter_mut();
        let mut push = |value| {
            if let Some((_, values)) = column.next() {
                values.push(value);
            }
        };
        push(plain.stamp(row).seconds());
        plain.cells(row, |cell| push(cell.unwrap_or(f64::NAN)));
    }
    write_parquet(&columns).map_err(|error| Error::usage(error.finding()))
}

/// A sensor that is interpolated to the stamps of `other`.
fn joined(sensor: Sensor, other: &str) -> Finding {
    Finding::of(Kind::CLOCK_JOINED)
        .of_sensor(sensor)
        .detail("other", other)
}

/// A recording as one table.
struct Plain<'a> {
    names: Vec<String>,
    zero_ns: i128,
    streams: Vec<Stream>,
    temperature: Option<&'a Temperature>,
    field: Option<&'a Magnetometer>,
}

impl<'a> Plain<'a> {
    /// The table of `recording`, with warnings added where a clock is given up.
    fn of(recording: &'a mut Recording) -> Self {
        let mut names = vec!["t".to_owned()];
        let mut streams: Vec<Stream> = Vec::new();
        for (stream, axes) in [
            (&recording.accelerometer, ["ax", "ay", "az"]),
            (&recording.gyroscope, ["gx", "gy", "gz"]),
        ] {
            if let Some(stream) = stream {
                names.extend(axes.map(str::to_owned));
                streams.push(stream.clone());
            }
        }
        if let [first, second] = streams.as_mut_slice()
            && first.t != second.t
        {
            recording
                .warnings
                .push(joined(Sensor::Gyroscope, "accelerometer"));
            *first = within(first, second);
            let values = first.t.iter().filter_map(|&t| second.at(t)).collect();
            *second = Stream {
                t: first.t.clone(),
                values,
            };
        }
        if recording.temperature.is_some() {
            names.push("temp".to_owned());
        }
        if let Some(field) = &recording.magnetometer {
            names.extend(field_names(field).split(',').map(str::to_owned));
            let stamps = streams.first().map(|first| &first.t);
            if stamps.is_some_and(|stamps| *stamps != field.stream.t) {
                recording
                    .warnings
                    .push(joined(Sensor::Magnetometer, "others"));
            }
        }
        Self {
            names,
            zero_ns: recording.zero_ns,
            streams,
            temperature: recording.temperature.as_ref(),
            field: recording.magnetometer.as_ref(),
        }
    }

    /// Those of the first sensor; of a magnetometer, where it is alone.
    fn stamps(&self) -> &[f64] {
        let field = self.field.map(|field| &field.stream);
        let first = self.streams.first().or(field);
        first.map_or(&[][..], |stream| &stream.t)
    }

    fn rows(&self) -> usize {
        self.stamps().len()
    }

    fn stamp(&self, row: usize) -> FileStamp {
        FileStamp {
            zero_ns: self.zero_ns,
            t: self.stamps()[row],
        }
    }

    /// Hands over the cells of a row behind its stamp, `None` where there is nothing.
    fn cells(&self, row: usize, mut cell: impl FnMut(Option<f64>)) {
        let t = self.stamps()[row];
        for stream in &self.streams {
            stream.values[row]
                .iter()
                .for_each(|value| cell(Some(*value)));
        }
        if let Some(temperature) = self.temperature {
            cell(temperature.at(t));
        }
        if let Some(field) = self.field {
            // Nothing where it was not on.
            let stamps = &field.stream.t;
            let on = stamps.first() <= Some(&t) && Some(&t) <= stamps.last();
            let value = field.stream.at(t).filter(|_| on);
            (0..3).for_each(|axis| cell(value.map(|value| value[axis])));
        }
    }
}

/// The names of a magnetometer's columns, with its unit where it is known: `mx (gauss),my (gauss),mz (gauss)`.
pub fn field_names(field: &Magnetometer) -> String {
    let unit = field.unit.map(|unit| format!(" ({})", unit.name()));
    let unit = unit.unwrap_or_default();
    ["mx", "my", "mz"]
        .map(|name| format!("{name}{unit}"))
        .join(",")
}

/// One sensor as CSV with the given column names; `zero_ns` is the recording's.
pub fn stream_to_csv(stream: &Stream, names: &str, zero_ns: i128) -> String {
    let mut text = format!("{names}\n");
    for (&t, v) in stream.t.iter().zip(&stream.values) {
        let stamp = FileStamp { zero_ns, t };
        let _ = writeln!(text, "{stamp},{},{},{}", v.x, v.y, v.z);
    }
    text
}

/// The samples of `stream` within the time of `other`.
fn within(stream: &Stream, other: &Stream) -> Stream {
    let (Some(&from), Some(&to)) = (other.t.first(), other.t.last()) else {
        return Stream::default();
    };
    let range = stream.t.partition_point(|&t| t < from)..stream.t.partition_point(|&t| t <= to);
    Stream {
        t: stream.t[range.clone()].to_vec(),
        values: stream.values[range].to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::ReadOptions;
    use nalgebra::Vector3;

    #[test]
    fn stamps_since_1970_are_written_as_they_were_read() {
        let stamps: Vec<String> = (0..40)
            .map(|k| format!("1764370000.{:06}", 500_001 + 10_000 * k))
            .collect();
        let mut file = "t,ax,ay,az,gx,gy,gz\n".to_owned();
        for (k, stamp) in stamps.iter().enumerate() {
            let _ = writeln!(file, "{stamp},0.{k},0.2,9.8,0.0{k},0.002,0.003");
        }
        let options = ReadOptions::default();
        let mut read = Recording::from_bytes("r", file.into_bytes(), &options).unwrap();
        let text = to_csv(&mut read);
        let written = text
            .lines()
            .skip(1)
            .filter_map(|line| line.split(',').next());
        assert!(written.eq(stamps.iter().map(String::as_str)));
        let again = Recording::from_bytes("r", text.into_bytes(), &options).unwrap();
        assert_eq!(again.accelerometer, read.accelerometer);
    }

    #[test]
    fn a_magnetometer_alone_keeps_its_samples_and_its_stamps() {
        let t: Vec<f64> = (0..100).map(|k| 0.05 * f64::from(k)).collect();
        let of = |t: &f64| Vector3::new(20.0 + t, 5.0 - t, -40.0 + t.sin());
        let values = t.iter().map(of).collect();
        let mut alone = Recording {
            magnetometer: Some(Magnetometer::in_microtesla(Stream { t, values })),
            ..Recording::default()
        };
        let text = to_csv(&mut alone);
        assert!(alone.warnings.is_empty());
        let read = Recording::from_bytes("r", text.into_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(
            read.magnetometer.unwrap().stream,
            alone.magnetometer.unwrap().stream
        );
    }
}
