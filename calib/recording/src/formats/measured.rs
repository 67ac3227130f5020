//! Binary and structured files, read by `stillpoint-formats`: streams to tables, and the choice among several.

use file_formats::{Content, Quantity, Stream, Wanted};
use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;
use sensor::Sensor;

use crate::Error;
use crate::formats::format::Format;
use crate::formats::log_streams;
use crate::recording::assemble::assemble;
use crate::recording::options::Role;
use crate::recording::samples::{Pushed, Samples};
use crate::recording::sessions::refuse_part;
use crate::recording::{AppliedBefore, Magnetometer, ReadOptions, Recording};
use crate::rows::table::Table;
use crate::shown::{figure, shown, shown_list};
use crate::source::Source;
use crate::source::place::in_file;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// The format of `stillpoint-formats` that is called so.
#[derive(Debug)]
pub(crate) struct Measured(pub &'static str);

/// Names of what a log holds that a message lists.
const LISTED: usize = 12;

/// Stamps from here on are epochs, ns: what is before their first whole second is subtracted.
const EPOCH: i64 = 1_000_000_000_000_000;

findings::tuning! {
    /// Slower streams are no recording of turns, Hz.
    SLOW: f64 = 10.0;
}

impl Format for Measured {
    fn name(&self) -> &'static str {
        self.0
    }

    fn about(&self) -> &'static str {
        let format = file_formats::FORMATS
            .iter()
            .find(|format| format.name == self.0);
        format.map_or("", |format| format.about)
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Binary(binary) if binary.format.name == self.0)
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let Source::Binary(binary) = source else {
            return Err(crate::formats::format::mismatch(
                source.name(),
                self,
                "its own files",
            ));
        };
        let name = binary.name.clone();
        let of = |kind: Kind| Finding::of(kind).in_file(&name);
        if !options.columns.0.is_empty() {
            return Err(Error::usage(of(Kind::COLUMNS_OF_LOG)));
        }
        if let (Some(device), None) = (&options.device, options.instance) {
            let other = of(Kind::INSTANCE_NOT_NUMBER).detail("instance", shown(device));
            return Err(Error::usage(other));
        }
        refuse_part(&name, options)?;
        let wanted = Wanted {
            topics: options.topics.clone(),
            instance: options.instance,
        };
        let content = log_streams::content(binary, &wanted, options)?;
        recording(&name, content, options)
    }
}

/// The recording in `content`.
fn recording(name: &str, content: Content, options: &ReadOptions) -> Result<Recording, Error> {
    let Content {
        mut streams,
        listed,
        unclear,
        mut warnings,
        cut,
    } = content;
    let chooser = Chooser { name, options };
    let accel = chooser.take(&mut streams, Quantity::SpecificForce)?;
    let gyro = chooser.take(&mut streams, Quantity::AngularRate)?;
    if accel.is_none() && gyro.is_none() {
        let why = cut.as_ref().or_else(|| warnings.first());
        return Err(in_file(name, without_sensor(&listed, why)));
    }
    let all_wanted = options.topics.is_empty() && !unclear.is_empty();
    let one = [(Sensor::Gyroscope, &accel), (Sensor::Accelerometer, &gyro)];
    if let [(missing, Some(known)), (_, None)] | [(_, None), (missing, Some(known))] = one
        && all_wanted
    {
        let topic = Remedy::such_as(OptionName::Topic, shown(&known.source));
        let found = Finding::of(Kind::LOG_SENSOR_UNCLEAR)
            .of_sensor(missing)
            .detail("unclear", shown_list(unclear.iter()))
            .only_remedies([topic]);
        return Err(in_file(name, found));
    }
    let of_accel = |stream: &Stream| {
        accel
            .as_ref()
            .is_some_and(|a| a.source == stream.source && a.instance == stream.instance)
    };
    let field = streams
        .iter()
        .filter(|stream| stream.quantity == Quantity::MagneticField)
        .min_by_key(|stream| (!of_accel(stream), stream.instance));
    let field = field.cloned();
    let temperature = streams
        .iter()
        .position(|stream| stream.quantity == Quantity::Temperature && of_accel(stream));
    let temperature = temperature.map(|at| streams.swap_remove(at));
    let origin = origin([&accel, &gyro].into_iter().flatten());
    let mut tables = Vec::new();
    let mut applied_before = Vec::new();
    for (sensor, stream) in [(Sensor::Accelerometer, accel), (Sensor::Gyroscope, gyro)] {
        if let Some(stream) = stream {
            applied_before.extend(stream.correction.map(|correction| AppliedBefore {
                undone: correction.undone,
                ..AppliedBefore::by(correction.by, sensor)
            }));
            tables.push(table(name, sensor, stream, origin, options)?);
        }
    }
    if let (Some(temperature), Some(table)) = (temperature, tables.first_mut()) {
        add_temperature(table, &temperature, origin);
    }
    warnings.extend(cut);
    let warnings = warnings.into_iter().map(|f| f.in_recording(name));
    let warnings: Vec<Finding> = warnings.collect();
    let mut recording = assemble(name.to_owned(), tables, options)?;
    if options.rate.is_none() {
        recording.zero_ns = i128::from(origin);
    }
    recording.magnetometer = field.and_then(|field| magnetometer(name, field, origin, options));
    recording.warnings.extend(warnings);
    recording.description.applied_before = applied_before;
    Ok(recording)
}

/// A log that holds neither accelerometer nor gyroscope, with what it lists and why it may end early.
fn without_sensor(listed: &[String], why: Option<&Finding>) -> Finding {
    let listed = match listed {
        [] => "nothing".to_owned(),
        [first @ .., _] if first.len() < LISTED => listed.join(", "),
        all => format!(
            "{} and {} more",
            all[..LISTED].join(", "),
            all.len() - LISTED
        ),
    };
    let found = Finding::of(Kind::LOG_WITHOUT_SENSOR).detail("listed", shown(&listed));
    match why {
        Some(why) => found.detail("why", shown(&why.what())),
        None => found,
    }
}

/// The whole second that stamps which tell the date are counted from, ns; 0 for others.
fn origin<'a>(streams: impl Iterator<Item = &'a Stream>) -> i64 {
    let first = streams.filter_map(|stream| stream.stamps.first()).min();
    let first = first.filter(|first| first.abs() >= EPOCH);
    first.map_or(0, |first| first - first.rem_euclid(1_000_000_000))
}

/// Adds the temperatures of a stream, those that go back in time left out.
fn add_temperature(table: &mut Table, stream: &Stream, origin: i64) {
    for (stamp, value) in stream.stamps.iter().zip(&stream.values) {
        let t = seconds(*stamp, origin);
        if table.temperature_t.last().is_none_or(|last| t > *last) {
            table.temperature_t.push(t);
            table.temperature.push(value[0]);
        }
    }
}

/// The magnetometer in a stream.
fn magnetometer(
    file: &str,
    stream: Stream,
    origin: i64,
    options: &ReadOptions,
) -> Option<Magnetometer> {
    let t: Vec<f64> = stream.stamps.iter().map(|t| seconds(*t, origin)).collect();
    let values: Vec<Vector3<f64>> = stream.values.into_iter().map(Vector3::from).collect();
    let column = |axis: usize| {
        let letter = ["x", "y", "z"][axis];
        (
            Role::Field(axis).name(),
            format!("{}.{letter}", stream.source),
        )
    };
    let stated = stream.unit.and_then(|unit| unit.parse().ok());
    Some(Magnetometer {
        unit: options.mag_unit.or(stated).and_then(FieldUnit::known),
        source: format!("{file} ({})", shown(&stream.source)),
        columns: (0..3).map(column).collect(),
        ..Magnetometer::of(&t, &values)?
    })
}

fn seconds(stamp: i64, origin: i64) -> f64 {
    stamp.saturating_sub(origin) as f64 * 1e-9
}

/// One sensor's samples as a table of its own.
fn table(
    file: &str,
    sensor: Sensor,
    stream: Stream,
    origin: i64,
    options: &ReadOptions,
) -> Result<Table, Error> {
    let name = format!("{file} ({}{})", shown(&stream.source), numbered(&stream));
    let (in_si, source) = (stream.in_si, stream.source);
    let finite = stream
        .values
        .iter()
        .position(|value| !value.iter().all(|v| v.is_finite() && v.abs() < 1e15));
    if let Some(at) = finite.filter(|_| !options.na_drop) {
        let found = Finding::of(Kind::RECORD_NOT_FINITE).count("record", at + 1);
        return Err(in_file(&name, found));
    }
    let stamps: Vec<f64> = match options.rate {
        Some(rate) => (0..stream.stamps.len()).map(|k| k as f64 / rate).collect(),
        None => stream
            .stamps
            .into_iter()
            .map(|stamp| seconds(stamp, origin))
            .collect(),
    };
    let values: Vec<Vector3<f64>> = stream.values.into_iter().map(Vector3::from).collect();
    let samples = samples(&name, stamps, values, options)?;
    let mut table = Table {
        has_time: true,
        ..Table::default()
    };
    table.stated.time = Some(TimeUnit::Seconds);
    match sensor {
        Sensor::Accelerometer => {
            table.accel = samples;
            table.stated.accel = in_si.then_some(AccelUnit::MetresPerSecondSquared);
        }
        Sensor::Gyroscope => {
            table.gyro = samples;
            table.stated.gyro = in_si.then_some(GyroUnit::RadiansPerSecond);
        }
        Sensor::Magnetometer => table.magnetometer = samples,
    }
    table.roles = (0..3)
        .map(|axis| {
            (
                Role::axis(sensor, axis),
                format!("{source}.{}", ["x", "y", "z"][axis]),
            )
        })
        .collect();
    table.name = name;
    Ok(table)
}

/// The samples in order, each stamp once; those that are not finite are left out.
fn samples(
    name: &str,
    t: Vec<f64>,
    values: Vec<Vector3<f64>>,
    options: &ReadOptions,
) -> Result<Samples, Error> {
    let ascends = t.windows(2).all(|pair| pair[0] < pair[1]);
    let finite = |value: &Vector3<f64>| value.iter().all(|v| v.is_finite() && v.abs() < 1e15);
    if ascends && values.iter().all(finite) {
        return Ok(Samples::of(t, values));
    }
    let mut samples = Samples::default();
    for ((record, t), value) in (1..).zip(t).zip(values) {
        if !finite(&value) {
            continue;
        }
        if options.sort_time {
            samples.append(t, value, record);
        } else if let Pushed::Backwards(last) = samples.push(t, value, record) {
            let found = Finding::of(Kind::TIME_GOES_BACK)
                .count("record", record as usize)
                .detail("from", figure(last))
                .detail("to", figure(t));
            return Err(in_file(name, found));
        }
    }
    Ok(samples)
}

/// The number of an instance, where it is not the only one of its kind.
fn numbered(stream: &Stream) -> String {
    match stream.source.starts_with('/') {
        true => String::new(),
        false => format!(" {}", stream.instance),
    }
}

struct Chooser<'a> {
    name: &'a str,
    options: &'a ReadOptions,
}

impl Chooser<'_> {
    /// Takes the one stream of a quantity out of `streams`; none where there is none.
    fn take(&self, streams: &mut Vec<Stream>, quantity: Quantity) -> Result<Option<Stream>, Error> {
        let of = |processed: bool| {
            let is = |stream: &Stream| stream.quantity == quantity && stream.processed == processed;
            (0..streams.len())
                .filter(|&at| is(&streams[at]))
                .collect::<Vec<usize>>()
        };
        let (raw, processed) = (of(false), of(true));
        let mut candidates = if raw.is_empty() {
            processed.clone()
        } else {
            raw
        };
        // Blocks of raw readings beside single ones are the same sensor, faster.
        let fifo = |at: &usize| streams[*at].source.ends_with("_fifo");
        if candidates.iter().any(fifo) {
            candidates.retain(fifo);
        }
        match candidates[..] {
            [] => Ok(None),
            [at] => {
                if self.options.topics.is_empty() {
                    self.refuse_slow(&streams[at], processed.first().map(|&at| &streams[at]))?;
                }
                Ok(Some(streams.swap_remove(at)))
            }
            [first, ..] => {
                let of: Vec<&Stream> = candidates.iter().map(|&at| &streams[at]).collect();
                Err(self.ask(&of, &streams[first]))
            }
        }
    }

    /// Refuses a log that holds the sensor a few times a second only.
    fn refuse_slow(&self, stream: &Stream, processed: Option<&Stream>) -> Result<(), Error> {
        let rate = stream.rate();
        if !stream.source.starts_with("sensor_") || rate >= SLOW.get() {
            return Ok(());
        }
        let instead = processed.filter(|stream| stream.rate() >= SLOW.get());
        let found = Finding::of(Kind::LOGGED_SLOWLY)
            .in_file(self.name)
            .detail("stream", shown(&stream.source))
            .number("rate", rate, "Hz");
        Err(Error::not_enough(match instead {
            Some(other) => found
                .detail("other", shown(&other.source))
                .number("other_rate", other.rate().round(), "Hz")
                .remedy(Remedy::such_as(OptionName::Topic, shown(&other.source))),
            None => found,
        }))
    }

    /// Lists the streams among which the user has to choose.
    fn ask(&self, streams: &[&Stream], first: &Stream) -> Error {
        let listed: Vec<String> = streams
            .iter()
            .map(|stream| {
                format!(
                    "{}{} ({} samples, {:.0} Hz)",
                    shown(&stream.source),
                    numbered(stream),
                    stream.stamps.len(),
                    stream.rate()
                )
            })
            .collect();
        let by_instance = streams.iter().all(|stream| stream.source == first.source);
        let option = match by_instance {
            true => Remedy::such_as(OptionName::Instance, first.instance.to_string()),
            false => Remedy::such_as(OptionName::Topic, shown(&first.source)),
        };
        let sensor = match first.quantity {
            Quantity::SpecificForce => Sensor::Accelerometer,
            _ => Sensor::Gyroscope,
        };
        in_file(
            self.name,
            Finding::of(Kind::LOG_SENSORS_OPEN)
                .of_sensor(sensor)
                .count("count", streams.len())
                .detail("listed", listed.join(", "))
                .only_remedies([option]),
        )
    }
}
