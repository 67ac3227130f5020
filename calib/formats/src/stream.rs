//! Content of a file: streams of samples, each on its clock, in SI units.
use findings::{Finding, Findings, Kind};

use crate::error::counted;
use crate::shown::shown;

/// Physical quantity of a stream's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Specific force of an accelerometer, m/s².
    SpecificForce,
    /// Angular rate of a gyroscope, rad/s.
    AngularRate,
    /// Magnetic field of a magnetometer, in [`Stream::unit`].
    MagneticField,
    /// Temperature of a thermometer, °C; only the first value is used.
    Temperature,
}

/// Samples of one sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    /// The topic, message or variable that it is read from.
    pub source: String,
    /// Number of the sensor among several of the same kind.
    pub instance: u32,
    /// Quantity of the values.
    pub quantity: Quantity,
    /// Corrected by the device already: taken where nothing else is there.
    pub processed: bool,
    /// Who corrected it, and whether that is taken off again.
    pub correction: Option<Correction>,
    /// The values are in the unit of `quantity`; otherwise in one that the file does not state.
    pub in_si: bool,
    /// Unit of a magnetometer, where the format states it: `T`, `µT`, `gauss`.
    pub unit: Option<&'static str>,
    /// Stamps, ns since whenever the file's clock began.
    pub stamps: Vec<i64>,
    /// Samples.
    pub values: Vec<[f64; 3]>,
}

impl Stream {
    /// Without samples yet.
    pub fn new(source: &str, instance: u32, quantity: Quantity) -> Self {
        Self {
            source: source.to_owned(),
            instance,
            quantity,
            processed: false,
            correction: None,
            in_si: true,
            unit: None,
            stamps: Vec::new(),
            values: Vec::new(),
        }
    }

    /// Mean rate between the first and the last sample, Hz; 0 with fewer than two.
    pub fn rate(&self) -> f64 {
        let ends = self.stamps.first().zip(self.stamps.last());
        let span = ends.map_or(0.0, |(first, last)| {
            last.saturating_sub(*first) as f64 * 1e-9
        });
        match span > 0.0 {
            true => (self.stamps.len() - 1) as f64 / span,
            false => 0.0,
        }
    }
}

/// Correction that the recording system applied to a stream's readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Correction {
    /// The system: `px4`, `ardupilot`.
    pub by: &'static str,
    /// Taken off again: the readings are those of the sensor.
    pub undone: bool,
}

/// A file that ends within something.
pub(crate) fn cut_at(byte: u64, within: &str) -> Finding {
    Finding::of(Kind::FILE_CUT)
        .detail("within", within)
        .count("byte", byte as usize)
}

/// A chunk of a log that is damaged.
pub(crate) fn chunk_damaged(byte: u64) -> Finding {
    Finding::of(Kind::CHUNK_DAMAGED).count("byte", byte as usize)
}

/// Content of a file.
#[derive(Clone, Debug, Default)]
pub struct Content {
    /// Streams with samples.
    pub streams: Vec<Stream>,
    /// Everything there is, by name and kind, for the message where no stream is a sensor's.
    pub listed: Vec<String>,
    /// Names of unread sources that may be sensors; the user is asked about them if a sensor is missing.
    pub unclear: Vec<String>,
    /// Warnings from reading.
    pub warnings: Findings,
    /// Why reading ended before the file did.
    pub cut: Option<Finding>,
}

impl Content {
    /// The corrected streams that are read, for no stream of what the sensor itself reads is beside them.
    pub(crate) fn corrected(&mut self) -> impl Iterator<Item = &mut Stream> {
        let has_samples = |stream: &&Stream| !stream.stamps.is_empty();
        let raw: Vec<Quantity> = self
            .streams
            .iter()
            .filter(has_samples)
            .filter(|s| !s.processed)
            .map(|s| s.quantity)
            .collect();
        let corrected = self
            .streams
            .iter_mut()
            .filter(|s| s.processed && !s.stamps.is_empty());
        corrected.filter(move |s| !raw.contains(&s.quantity))
    }
}

/// Selection of the streams to read.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Topics, messages or variables; all where there are none.
    pub topics: Vec<String>,
    /// The one instance.
    pub instance: Option<u32>,
}

impl Wanted {
    /// True for what is to be kept.
    pub fn is(&self, source: &str, instance: u32) -> bool {
        (self.topics.is_empty() || self.topics.iter().any(|topic| topic == source))
            && self.instance.is_none_or(|wanted| wanted == instance)
    }
}

/// Streams while they are read, within limits.
#[derive(Debug)]
pub(crate) struct Recorder {
    pub content: Content,
    wanted: Wanted,
    rows: u64,
}

/// A stream of a recorder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Handle(usize);

impl Recorder {
    pub fn new(wanted: &Wanted, limits: crate::Limits) -> Self {
        Self {
            content: Content::default(),
            wanted: wanted.clone(),
            rows: limits.rows,
        }
    }

    /// The stream for `source`; `None` for one that is not wanted.
    pub fn stream(&mut self, source: &str, instance: u32, quantity: Quantity) -> Option<Handle> {
        if !self.wanted.is(source, instance) {
            return None;
        }
        let streams = &mut self.content.streams;
        let is_it =
            |s: &Stream| s.source == source && s.instance == instance && s.quantity == quantity;
        let at = streams.iter().position(is_it).unwrap_or_else(|| {
            streams.push(Stream::new(source, instance, quantity));
            streams.len() - 1
        });
        Some(Handle(at))
    }

    /// The stream of a magnetometer whose format states the unit.
    pub fn field(&mut self, source: &str, instance: u32, unit: &'static str) -> Option<Handle> {
        let handle = self.stream(source, instance, Quantity::MagneticField)?;
        self.at(handle).unit = Some(unit);
        Some(handle)
    }

    /// The stream itself.
    pub fn at(&mut self, Handle(at): Handle) -> &mut Stream {
        &mut self.content.streams[at]
    }

    /// Room for as many samples as are known to follow, within the limit.
    pub fn reserve(&mut self, handle: Handle, samples: usize) {
        let samples = samples.min(usize::try_from(self.rows).unwrap_or(usize::MAX));
        let stream = self.at(handle);
        stream.stamps.reserve_exact(samples);
        stream.values.reserve_exact(samples);
    }

    /// Adds a sample.
    ///
    /// # Errors
    /// More rows than the limit.
    pub fn push(
        &mut self,
        handle: Handle,
        stamp: i64,
        value: [f64; 3],
    ) -> Result<(), crate::Error> {
        let rows = self.rows;
        let stream = self.at(handle);
        if stream.stamps.len() as u64 >= rows {
            let found = Finding::of(Kind::SAMPLES_TOO_MANY).detail("stream", shown(&stream.source));
            return Err(crate::Error::refused(counted(found, "limit", rows)));
        }
        crate::stream::grow(&mut stream.stamps);
        crate::stream::grow(&mut stream.values);
        stream.stamps.push(stamp);
        stream.values.push(value);
        Ok(())
    }

    /// The file ends at byte `at`, within something.
    pub fn cut(&mut self, at: u64, within: &str) {
        self.content.cut = Some(cut_at(at, within));
    }

    /// The streams that have samples.
    pub fn finish(self) -> Content {
        let mut content = self.content;
        content.streams.retain(|stream| !stream.stamps.is_empty());
        content
    }
}

/// Samples that a stream has room for at first, and those from which on it is a long one.
const SHORT: usize = 1024;
/// Room for as many is so large that the system's allocator moves it without a copy when it grows, and costs nothing until
/// it is used.
const LONG: usize = 64 << 10;

/// Room for one more, by an eighth of what there is: doubling would take half as much again as is needed.
fn grow<T>(vector: &mut Vec<T>) {
    let length = vector.len();
    if length == vector.capacity() {
        vector.reserve_exact(match length {
            0 => SHORT,
            _ => (length / 8).max(LONG),
        });
    }
}
