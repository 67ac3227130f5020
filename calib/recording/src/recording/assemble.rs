//! Tables to a recording: seconds, SI units, order, and what is worth a warning.

use findings::{Finding, Findings, Kind, Remedy};
use std::collections::HashSet;

use sensor::Sensor;

use super::magnetometer::{self, Magnetometer};
use super::options::{ReadOptions, Role};
use super::samples::Samples;
use super::{AppliedBefore, Described, Frozen, Recording, Stream, Temperature, UnitBy};
use crate::Error;
use crate::clock::{held, time};
use crate::devices::mixed;
use crate::formats::robots::ardupilot_text;
use crate::header::{affine, unclear};
use crate::readings::{
    frozen, frozen_finding, without_failed_reads, without_frozen, without_stale,
};
use crate::recording::{checks, packets, sessions, thermometer};
use crate::rows::table::Table;
use crate::shown::figure;
use crate::source::place::in_file;
use crate::units::field::FieldUnit;
use crate::units::{
    AccelUnit, GyroUnit, Stated, TimeUnit, decide, hand_clock, repeated, swapped, values,
};

impl Recording {
    /// Returns true if stamps were ignored for a given rate.
    pub(super) fn has_ignored_stamps(&self) -> bool {
        self.warnings.has(Kind::STAMPS_IGNORED)
    }
}

/// The recording called `name` that `tables`, on one clock, hold.
pub(crate) fn assemble(
    name: String,
    mut tables: Vec<Table>,
    options: &ReadOptions,
) -> Result<Recording, Error> {
    let mut recording = Recording {
        name,
        ..Recording::default()
    };
    let part = sessions::take_one(
        &recording.name,
        &mut tables,
        options,
        &mut recording.warnings,
    )?;
    recording.name.push_str(&part);
    recording.zero_ns = in_seconds(&mut tables, options, &mut recording)?;
    for table in &mut tables {
        in_order(table, &mut recording.warnings)?;
    }
    // Who says which columns are what knows what is left. Before magnetometers and thermometers are taken out: theirs
    // may be all that is understood.
    if !options.columns.names_a_sensor() {
        unclear::refuse(&tables)?;
    }
    recording.warnings.extend(unclear::unread_field(&tables));
    recording
        .warnings
        .extend(tables.iter().find_map(magnetometer::dead));
    recording.magnetometer = Magnetometer::taken(&mut tables, options.mag_unit);
    match recording.magnetometer.is_some() && !tables.iter().any(Table::has_sensor) {
        // A temperature beside it is of no use without the sensors.
        true => tables.clear(),
        false => thermometer::join(&mut tables)?,
    }
    let unused = unused(&mut tables);
    let unread = unclear::unread_accelerometer(&tables);
    let gyroscope = tables.iter().find(|table| !table.gyro.t.is_empty());
    let gyroscope = gyroscope.map(SaidOfRate::of);
    swapped::refuse(&tables, options)?;
    for table in tables {
        add(&mut recording, table, options)?;
    }
    // Turns tell the unit by the right signs.
    flip(&mut recording, &options.flip);
    hand_clock::refuse(&recording)?;
    if let Some(said) = gyroscope {
        rate_in_its_unit(&mut recording, &said, options)?;
    }
    let erased = crate::readings::cut_erased_tail(&mut recording);
    recording.warnings.extend(erased);
    crate::readings::refuse_stopped(&recording)?;
    let frozen = frozen_finding(&recording);
    recording.warnings.extend(frozen);
    overlap(&recording)?;
    thermometer::check_clock(&mut recording);
    let missing = missing_sensor(&recording, &unused, unread);
    recording.warnings.extend(missing);
    // What is true of a row is true of both sensors in it, but said once.
    recording.warnings.once();
    Ok(recording)
}

/// Brings the stamps into seconds and returns their zero in nanoseconds; a given rate ignores them.
fn in_seconds(
    tables: &mut [Table],
    options: &ReadOptions,
    recording: &mut Recording,
) -> Result<i128, Error> {
    if options.rate.is_some() {
        if tables.iter().any(|table| table.has_time) {
            let ignored = Finding::of(Kind::STAMPS_IGNORED).in_recording(&recording.name);
            recording.warnings.push(ignored);
        }
        return Ok(recording.zero_ns);
    }
    let in_seconds = time::to_seconds(tables, options, &mut recording.warnings);
    if in_seconds.is_err() {
        // Stamps that most rows share have no step that tells their unit.
        for samples in tables.iter().flat_map(|table| [&table.accel, &table.gyro]) {
            checks::order(&recording.name, samples, &mut Findings::new())?;
        }
    }
    in_seconds
}

/// Holds the samples of each sensor of a table to their order, and makes one of those with one stamp.
fn in_order(table: &mut Table, warnings: &mut Findings) -> Result<(), Error> {
    let Table {
        name,
        accel,
        gyro,
        magnetometer,
        ..
    } = table;
    for (sensor, samples) in [(Sensor::Accelerometer, accel), (Sensor::Gyroscope, gyro)] {
        warnings.extend(packets::apart(name, sensor, samples));
        mixed::refuse(name, sensor, samples)?;
        checks::order(name, samples, warnings)?;
        samples.merge_twins();
    }
    magnetometer.merge_twins();
    Ok(())
}

/// The columns that no sensor reads: one that a table leaves may be another's.
fn unused(tables: &mut [Table]) -> Vec<String> {
    let roles = tables.iter().flat_map(|table| &table.roles);
    let read: HashSet<String> = roles.map(|(_, column)| column.clone()).collect();
    for table in tables.iter_mut() {
        table.unused.retain(|column| !read.contains(column));
    }
    tables
        .iter()
        .flat_map(|table| table.unused.clone())
        .collect()
}

/// Statement of a table about the unit of its gyroscope.
struct SaidOfRate {
    name: String,
    stated: Option<GyroUnit>,
    strange: Option<String>,
}

impl SaidOfRate {
    fn of(table: &Table) -> Self {
        Self {
            name: table.name.clone(),
            stated: table.stated.gyro,
            strange: table.strange[1].clone(),
        }
    }
}

/// Brings the gyroscope into rad/s by what was given and said, or by gravity in the turns.
fn rate_in_its_unit(
    recording: &mut Recording,
    own: &SaidOfRate,
    options: &ReadOptions,
) -> Result<(), Error> {
    let Some(stream) = recording.gyroscope.take() else {
        return Ok(());
    };
    let said = decide::Said {
        given: options.gyro_unit,
        stated: own.stated,
        strange: own.strange.as_deref(),
    };
    let accel = recording.accelerometer.as_ref();
    let warnings = &mut recording.warnings;
    let (unit, unit_by) = decide::gyro_unit(&own.name, &stream, accel, said, warnings)?;
    recording.gyroscope = Some(scaled(stream, unit.scale()));
    let sensors = recording.description.sensors.iter_mut();
    for described in sensors.filter(|described| described.sensor == Sensor::Gyroscope) {
        (described.unit, described.unit_by) = (unit.name(), unit_by);
    }
    Ok(())
}

/// The finding about a sensor that the tables do not hold, with their columns that nobody reads.
fn missing_sensor(
    recording: &Recording,
    unused: &[String],
    unread: Option<Remedy>,
) -> Option<Finding> {
    let sensors = [&recording.accelerometer, &recording.gyroscope].map(Option::is_some);
    let only = |missing: &str, only: &str| {
        Finding::of(Kind::ONE_SENSOR_ONLY)
            .detail("missing", missing)
            .detail("only", only)
    };
    let mut missing = match (sensors, recording.magnetometer.is_some()) {
        ([true, true], _) => return None,
        ([true, false], _) => only("gyroscope", "accelerometer"),
        ([false, true], _) => only("accelerometer", "gyroscope"),
        ([false, false], true) => {
            only("accelerometer", "magnetometer").detail("neither", "gyroscope")
        }
        ([false, false], false) => Finding::of(Kind::NO_SENSOR),
    };
    if !unused.is_empty() {
        missing = missing.detail("unused", format!("`{}`", unused.join("`, `")));
    }
    if let Some(columns) = unread.filter(|_| !sensors[0]) {
        missing = missing.remedy(columns);
    }
    Some(missing.in_recording(&recording.name))
}

fn add(recording: &mut Recording, mut table: Table, options: &ReadOptions) -> Result<(), Error> {
    recording.warnings.append(&mut table.warnings);
    if table.negated {
        table
            .accel
            .values
            .iter_mut()
            .for_each(|value| *value = -*value);
    }
    if table.corrected_by.is_none() && ardupilot_text::is_imu(&table.names) {
        table.corrected_by = Some("ardupilot");
        let corrected = ardupilot_text::corrected();
        recording.warnings.push(corrected.in_recording(&table.name));
    }
    describe(recording, &table, options);
    let celsius = match table.temperature.is_empty() {
        true => None,
        false => checks::celsius(&table, options, &mut recording.warnings),
    };
    let celsius = celsius.map(|celsius| Temperature {
        t: std::mem::take(&mut table.temperature_t),
        celsius,
    });
    let Table { name, stated, .. } = table;
    recording
        .warnings
        .extend(overridden(&name, stated, options));
    let said = decide::Said {
        given: options.accel_unit,
        stated: stated.accel,
        strange: table.strange[0].as_deref(),
    };
    let (accelerometer, gyroscope) = rayon::join(
        || {
            finish(
                &name,
                Sensor::Accelerometer,
                table.accel,
                |stream, warnings| decide::accel_unit(&name, stream, said, warnings),
            )
        },
        // Its unit is decided when the accelerometer is known.
        || finish(&name, Sensor::Gyroscope, table.gyro, |_, _| Ok(())),
    );
    if let Some((stream, unit, mut noticed)) = accelerometer? {
        recording.accelerometer = Some(scaled(stream, unit.scale()));
        recording.warnings.append(&mut noticed.warnings);
        recording.frozen.append(&mut noticed.frozen);
        let sensors = recording.description.sensors.iter_mut();
        sensors
            .filter(|described| described.sensor == Sensor::Accelerometer)
            .for_each(|own| (own.unit, own.unit_by) = (unit.name(), said.by()));
    }
    let gyroscope = match gyroscope {
        Err(_) if options.accelerometer_alone => None,
        found => found?,
    };
    if let Some((stream, (), mut noticed)) = gyroscope {
        recording.gyroscope = Some(stream);
        recording.warnings.append(&mut noticed.warnings);
        recording.frozen.append(&mut noticed.frozen);
    }
    recording.temperature = celsius.or(recording.temperature.take());
    Ok(())
}

/// Adds where the sensors of a table come from; their units are filled in when they are decided.
fn describe(recording: &mut Recording, table: &Table, options: &ReadOptions) {
    let sensors = [
        (Sensor::Accelerometer, &table.accel),
        (Sensor::Gyroscope, &table.gyro),
    ];
    for (sensor, samples) in sensors {
        if samples.t.is_empty() {
            continue;
        }
        if let Some(system) = table.corrected_by {
            let applied = AppliedBefore::by(system, sensor);
            recording.description.applied_before.push(applied);
        }
        let is_of = |role: &Role| *role == Role::Time || role.sensor() == Some(sensor);
        let columns = table.roles.iter().filter(|(role, _)| is_of(role));
        recording.description.sensors.push(Described {
            sensor,
            source: table.name.clone(),
            columns: columns
                .map(|(role, column)| (role.name(), column.clone()))
                .collect(),
            unused: table.unused.clone(),
            unit: "",
            unit_by: UnitBy::Nothing,
            turned: table.negated && sensor == Sensor::Accelerometer,
            flipped: flipped(sensor, options),
        });
    }
}

/// The axes of a sensor that options read with the other sign: `--flip gx`, or `--columns gx=-gyro_x`, and not both.
fn flipped(sensor: Sensor, options: &ReadOptions) -> Vec<&'static str> {
    let negated = |role: Role| {
        let mut columns = options.columns.0.iter().filter(|(own, _)| *own == role);
        columns
            .any(|(_, column)| affine::take_apart(column).is_some_and(|(_, own)| own.scale < 0.0))
    };
    let axes = (0..3).map(|axis| Role::axis(sensor, axis));
    axes.filter(|role| options.flip.contains(role) != negated(*role))
        .map(Role::name)
        .collect()
}

/// Builds a finding for each option that contradicts the unit in the file.
fn overridden(name: &str, stated: Stated, options: &ReadOptions) -> impl Iterator<Item = Finding> {
    let time = options.time_unit.map(TimeUnit::name);
    let accel = options.accel_unit.map(AccelUnit::name);
    let gyro = options.gyro_unit.map(GyroUnit::name);
    let mag = options.mag_unit.map(FieldUnit::name);
    let units = [
        ("the time", time, stated.time.map(TimeUnit::name)),
        (
            "the accelerometer",
            accel,
            stated.accel.map(AccelUnit::name),
        ),
        ("the gyroscope", gyro, stated.gyro.map(GyroUnit::name)),
        ("the magnetometer", mag, stated.field.map(FieldUnit::name)),
    ];
    units
        .into_iter()
        .filter_map(move |(quantity, given, said)| {
            let (given, said) = given.zip(said).filter(|(given, said)| given != said)?;
            let found = Finding::of(Kind::UNIT_OVERRIDDEN).in_recording(name);
            let found = found.detail("quantity", quantity).detail("given", given);
            Some(found.detail("stated", said))
        })
}

/// Findings about the samples of one sensor.
#[derive(Default)]
struct Noticed {
    warnings: Findings,
    frozen: Vec<Frozen>,
}

/// The stream of one sensor, checked, held and frozen values removed; its unit, and what was noticed. `None` without
/// samples.
fn finish<U>(
    name: &str,
    sensor: Sensor,
    samples: Samples,
    unit: impl FnOnce(&Stream, &mut Findings) -> Result<U, Error>,
) -> Result<Option<(Stream, U, Noticed)>, Error> {
    if samples.t.is_empty() {
        return Ok(None);
    }
    if !samples.t.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err(in_file(name, Finding::of(Kind::STAMPS_TOO_LARGE)));
    }
    let mut warnings = Findings::new();
    repeated::refuse(name, sensor, &samples)?;
    values::check(name, sensor, &samples, &mut warnings)?;
    let stream = Stream {
        t: samples.t,
        values: samples.values,
    };
    let stream = without_failed_reads(name, sensor, stream, &mut warnings);
    let frozen = frozen(sensor, &stream);
    let stream = held::without_held(name, sensor, stream, &mut warnings);
    let stream = without_stale(name, sensor, stream, &frozen, &mut warnings);
    let mut gaps = stream.gaps();
    gaps.retain(|gap| !frozen.iter().any(|f| f.is_between(gap.t0, gap.t1)));
    let behind = crate::clock::even::bursts(&stream.t);
    if let Some(behind) = &behind {
        gaps.retain(|gap| behind.loses_samples(gap));
    }
    checks::bursts(name, sensor, &stream, &gaps, behind.as_ref(), &mut warnings);
    checks::gaps(name, sensor, &gaps, &mut warnings);
    let stream = without_frozen(stream, &frozen);
    let unit = unit(&stream, &mut warnings)?;
    Ok(Some((stream, unit, Noticed { warnings, frozen })))
}

fn scaled(mut stream: Stream, scale: f64) -> Stream {
    if scale != 1.0 {
        stream.values.iter_mut().for_each(|value| *value *= scale);
    }
    stream
}

/// Turns the sign of axes.
fn flip(recording: &mut Recording, axes: &[Role]) {
    for role in axes {
        let Some((sensor, axis)) = role.reading() else {
            continue;
        };
        let stream = recording.stream_mut(sensor).into_iter();
        for value in stream.flat_map(|stream| &mut stream.values) {
            value[axis] = -value[axis];
        }
    }
}

/// Refuses sensors that were never on at the same time.
fn overlap(recording: &Recording) -> Result<(), Error> {
    let (Some(accel), Some(gyro)) = (&recording.accelerometer, &recording.gyroscope) else {
        return Ok(());
    };
    match (accel.span(), gyro.span()) {
        (Some((a0, a1)), Some((g0, g1))) if a1 < g0 || g1 < a0 => Err(in_file(
            &recording.name,
            Finding::of(Kind::NEVER_OVERLAP)
                .detail("accel_from", figure(a0))
                .detail("accel_to", figure(a1))
                .detail("gyro_from", figure(g0))
                .detail("gyro_to", figure(g1)),
        )),
        _ => Ok(()),
    }
}
