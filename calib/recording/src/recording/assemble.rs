//! Tables to a recording: seconds, SI units, order, and what is worth a warning.

use findings::{Finding, Findings, Kind};
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
    if options.rate.is_none() {
        let in_seconds = time::to_seconds(&mut tables, options, &mut recording.warnings);
        if in_seconds.is_err() {
            // Stamps that most rows share have no step that tells their unit.
            for samples in tables.iter().flat_map(|table| [&table.accel, &table.gyro]) {
                checks::order(&recording.name, samples, &mut Findings::new())?;
            }
        }
        recording.zero_ns = in_seconds?;
    } else if tables.iter().any(|table| table.has_time) {
        let ignored = Finding::of(Kind::STAMPS_IGNORED);
        recording
            .warnings
            .push(ignored.in_recording(&recording.name));
    }
    for Table {
        name,
        accel,
        gyro,
        magnetometer,
        ..
    } in &mut tables
    {
        for (sensor, samples) in [(Sensor::Accelerometer, accel), (Sensor::Gyroscope, gyro)] {
            recording
                .warnings
                .extend(packets::apart(name, sensor, samples));
            mixed::refuse(name, sensor, samples)?;
            checks::order(name, samples, &mut recording.warnings)?;
            samples.merge_twins();
        }
        magnetometer.merge_twins();
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
    // A column that one sensor leaves is another's.
    let read: HashSet<String> = tables
        .iter()
        .flat_map(|table| table.roles.iter().map(|(_, column)| column.clone()))
        .collect();
    for table in &mut tables {
        table.unused.retain(|column| !read.contains(column));
    }
    let unused: Vec<String> = tables
        .iter()
        .flat_map(|table| table.unused.clone())
        .collect();
    let unread = unclear::unread_accelerometer(&tables);
    let gyro = tables.iter().find(|table| !table.gyro.t.is_empty());
    let gyro = gyro.map(|table| {
        let strange = table.strange[1].clone();
        (table.name.clone(), table.stated.gyro, strange)
    });
    swapped::refuse(&tables, options)?;
    for table in tables {
        add(&mut recording, table, options)?;
    }
    // Turns tell the unit by the right signs.
    flip(&mut recording, &options.flip);
    hand_clock::refuse(&recording)?;
    if let (Some((name, stated, strange)), Some(stream)) = (gyro, recording.gyroscope.take()) {
        let said = decide::Said {
            given: options.gyro_unit,
            stated,
            strange: strange.as_deref(),
        };
        let accel = recording.accelerometer.as_ref();
        let warnings = &mut recording.warnings;
        let (unit, unit_by) = decide::gyro_unit(&name, &stream, accel, said, warnings)?;
        recording.gyroscope = Some(scaled(stream, unit.scale()));
        let sensors = recording.description.sensors.iter_mut();
        for described in sensors.filter(|described| described.sensor == Sensor::Gyroscope) {
            (described.unit, described.unit_by) = (unit.name(), unit_by);
        }
    }
    let erased = crate::readings::cut_erased_tail(&mut recording);
    recording.warnings.extend(erased);
    crate::readings::refuse_stopped(&recording)?;
    let frozen = frozen_finding(&recording);
    recording.warnings.extend(frozen);
    overlap(&recording)?;
    thermometer::check_clock(&mut recording);
    let sensors = [&recording.accelerometer, &recording.gyroscope].map(Option::is_some);
    let only = |missing: &str, only: &str| {
        Finding::of(Kind::ONE_SENSOR_ONLY)
            .detail("missing", missing)
            .detail("only", only)
    };
    let missing = match (sensors, recording.magnetometer.is_some()) {
        ([true, true], _) => None,
        ([true, false], _) => Some(only("gyroscope", "accelerometer")),
        ([false, true], _) => Some(only("accelerometer", "gyroscope")),
        ([false, false], true) => {
            Some(only("accelerometer", "magnetometer").detail("neither", "gyroscope"))
        }
        ([false, false], false) => Some(Finding::of(Kind::NO_SENSOR)),
    };
    let missing = missing.map(|missing| match unused.is_empty() {
        true => missing,
        false => missing.detail("unused", format!("`{}`", unused.join("`, `"))),
    });
    let missing = missing.map(|missing| match unread.filter(|_| !sensors[0]) {
        Some(columns) => missing.remedy(columns),
        None => missing,
    });
    recording
        .warnings
        .extend(missing.map(|missing| missing.in_recording(&recording.name)));
    // What is true of a row is true of both sensors in it, but said once.
    recording.warnings.once();
    Ok(recording)
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
