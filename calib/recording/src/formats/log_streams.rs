//! List of the streams in a log (bag, flight log), for the user to choose from.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use file_formats::{Content, Quantity, Stream, Wanted};
use findings::{Finding, Front, Kind, OptionName, Setting};

use crate::Error;
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::source::files::limits;
use crate::source::{Binary, Source};

/// The streams of sensors in a log.
#[derive(Clone, Debug)]
pub struct LogContents {
    /// The name of the format.
    pub format: &'static str,
    /// The streams, by sensor.
    pub streams: Vec<LogStream>,
}

/// One sensor's stream in a log.
#[derive(Clone, Debug)]
pub struct LogStream {
    /// `accelerometer`, `gyroscope`, `magnetometer` or `thermometer`.
    pub sensor: &'static str,
    /// The topic, message or variable.
    pub source: String,
    /// Number of the sensor among several of one source.
    pub instance: u32,
    /// Its samples.
    pub samples: usize,
    /// Their mean rate, Hz.
    pub rate: f64,
    /// Corrected by the device already.
    pub processed: bool,
    /// The options that choose it; none for the only one of its kind.
    pub settings: Vec<Setting>,
}

findings::tuning! {
    /// Fewer samples a second show no turn, Hz.
    SLOWEST: f64 = 5.0;
}

impl LogContents {
    /// True where a sensor that is calibrated is there more than once.
    pub fn has_choice(&self) -> bool {
        let mut calibrated = self.streams.iter().filter(|s| s.is_calibrated());
        calibrated.any(LogStream::is_one_of_several)
    }

    /// The options that choose the first of them that a calibration can use, as a front writes them: with enough samples, and as the sensor
    /// read it where there is one.
    pub fn first_option(&self, front: Front) -> Option<String> {
        let use_of = |s: &LogStream| (s.is_calibrated(), s.rate >= SLOWEST.get(), !s.processed);
        let several = self.streams.iter().filter(|s| s.is_one_of_several());
        // Of equals the first.
        let first = several.rev().max_by_key(|s| use_of(s));
        first?.option(front)
    }
}

impl LogStream {
    /// The options that choose it, as a front writes them; none for the only one of its kind.
    pub fn option(&self, front: Front) -> Option<String> {
        let options: Vec<String> = self.settings.iter().map(|s| s.text(front)).collect();
        (!options.is_empty()).then(|| options.join(" "))
    }

    fn is_one_of_several(&self) -> bool {
        !self.settings.is_empty()
    }

    fn is_calibrated(&self) -> bool {
        matches!(self.sensor, "accelerometer" | "gyroscope")
    }
}

impl Recording {
    /// The streams in the log at `path`; `None` for a file that is no log.
    ///
    /// # Errors
    /// As [`Recording::read`], but for streams among which nobody has chosen.
    pub fn streams_in(path: &Path, options: &ReadOptions) -> Result<Option<LogContents>, Error> {
        let Source::Binary(binary) = Source::open(path, options)? else {
            return Ok(None);
        };
        let format = binary.format.name;
        let content = content(binary, &Wanted::default(), options)?;
        Ok(Some(LogContents {
            format,
            streams: listed(&content.streams),
        }))
    }
}

/// Reads the wanted streams of a file. A panic of its parser becomes an error.
pub(super) fn content(
    mut binary: Binary,
    wanted: &Wanted,
    options: &ReadOptions,
) -> Result<Content, Error> {
    let limits = limits(options);
    // Unpackers of other projects are within.
    let read = AssertUnwindSafe(|| match &binary.path {
        Some(path) => {
            let mut file = std::fs::File::open(path)?;
            binary.format.read_seekable(&mut file, wanted, limits)
        }
        None => binary.format.read(&mut binary.reader, wanted, limits),
    });
    let content = catch_unwind(read).unwrap_or_else(|_| {
        let gave_up = Finding::of(Kind::READER_GAVE_UP);
        Err(file_formats::Error::at(0, gave_up))
    });
    let content = content.map_err(|error| Error::input(error.finding().in_file(&binary.name)))?;
    if let Some(file) = binary.unchanged {
        file.check()?;
    }
    Ok(content)
}

fn listed(streams: &[Stream]) -> Vec<LogStream> {
    let mut sorted: Vec<&Stream> = streams.iter().collect();
    sorted.sort_by_key(|s| (s.quantity, s.processed, s.instance, s.source.clone()));
    sorted.iter().map(|stream| of(stream, &sorted)).collect()
}

fn of(stream: &Stream, all: &[&Stream]) -> LogStream {
    let alike = || all.iter().filter(|other| other.quantity == stream.quantity);
    let of_source = alike()
        .filter(|other| other.source == stream.source)
        .count();
    let instance = stream.instance.to_string();
    let instance = (of_source > 1).then(|| Setting::to(OptionName::Instance, instance));
    let sources = alike().any(|other| other.source != stream.source);
    let topic = crate::shown::shown(&stream.source);
    let topic = sources.then(|| Setting::to(OptionName::Topic, topic));
    LogStream {
        sensor: match stream.quantity {
            Quantity::SpecificForce => "accelerometer",
            Quantity::AngularRate => "gyroscope",
            Quantity::MagneticField => "magnetometer",
            Quantity::Temperature => "thermometer",
        },
        source: stream.source.clone(),
        instance: stream.instance,
        samples: stream.stamps.len(),
        rate: stream.rate(),
        processed: stream.processed,
        settings: topic.into_iter().chain(instance).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream(source: &str, instance: u32, quantity: Quantity, processed: bool) -> Stream {
        Stream {
            processed,
            stamps: vec![0, 10_000_000],
            values: vec![[0.0; 3]; 2],
            ..Stream::new(source, instance, quantity)
        }
    }

    #[test]
    fn every_stream_of_several_has_the_option_that_chooses_it() {
        let streams = [
            stream("sensor_accel", 1, Quantity::SpecificForce, false),
            stream("sensor_accel", 0, Quantity::SpecificForce, false),
            stream("sensor_combined", 0, Quantity::SpecificForce, true),
            stream("sensor_gyro", 0, Quantity::AngularRate, false),
            stream("sensor_mag", 0, Quantity::MagneticField, false),
        ];
        let contents = LogContents {
            format: "ulog",
            streams: listed(&streams),
        };
        let options: Vec<_> = contents
            .streams
            .iter()
            .map(|s| s.option(Front::CommandLine))
            .collect();
        let options: Vec<_> = options.iter().map(Option::as_deref).collect();
        assert_eq!(
            options,
            [
                Some("--topic sensor_accel --instance 0"),
                Some("--topic sensor_accel --instance 1"),
                Some("--topic sensor_combined"),
                None,
                None
            ]
        );
        assert!(contents.has_choice());
        assert_eq!(contents.streams[0].rate, 100.0);
        let bag = listed(&[
            stream("/a", 0, Quantity::SpecificForce, false),
            stream("/b", 0, Quantity::SpecificForce, false),
        ]);
        assert_eq!(
            bag[1].option(Front::CommandLine).as_deref(),
            Some("--topic /b")
        );
    }
}
