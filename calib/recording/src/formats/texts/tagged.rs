//! Texts in which the first cell of a line says which sensor it is of.

use std::io::Read;

use super::text_format::TextFormat;
use crate::header::look::Look;
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, Stated, TimeUnit};

/// GetSensorData of the indoor positioning competitions: `ACCE;AppTimestamp;SensorTimestamp;x;y;z;accuracy`.
pub(crate) static GET_SENSOR_DATA: TextFormat = TextFormat {
    name: "get_sensor_data",
    about: "a log of GetSensorData: lines `ACCE;..` and `GYRO;..`, stamped by the sensor",
    parts: get_sensor_data,
};

/// GnssLogger of Google: `UncalAccel,utcTimeMillis,elapsedRealtimeNanos,x,y,z,..`.
pub(crate) static GNSS_LOGGER: TextFormat = TextFormat {
    name: "gnss_logger",
    about: "a log of GnssLogger: lines `UncalAccel,..` and `UncalGyro,..`, stamped by elapsedRealtimeNanos",
    parts: gnss_logger,
};

/// VectorNav's ASCII output.
pub(crate) static VECTORNAV: TextFormat = TextFormat {
    name: "vectornav",
    about: "VectorNav's `$VNIMU,mag,accel,gyro,temp,pressure*checksum`, `$VNYMR`, `$VNQMR`, `$VNMAR`; they have no stamps: the rate has to be given",
    parts: vectornav,
};

/// The lines that begin with one of `tags`, without it; the others are blank.
fn only(text: Box<dyn Read + Send>, tag: &'static [u8]) -> Box<dyn Read + Send> {
    rewritten(text, move |line, out| {
        if let Some(rest) = line.strip_prefix(tag) {
            out.extend_from_slice(rest);
        }
    })
}

fn begins(look: &Look, tags: &[&str]) -> bool {
    look.lines()
        .any(|line| tags.iter().any(|tag| line.starts_with(tag)))
}

/// The parts of lines with two stamps: the second, in `unit`, is the sensor's.
fn stamped(accel: Change, gyro: Change, field: Option<Change>, unit: TimeUnit) -> Vec<Part> {
    let stated = Stated {
        time: Some(unit),
        accel: Some(AccelUnit::MetresPerSecondSquared),
        gyro: Some(GyroUnit::RadiansPerSecond),
        field: Some(FieldUnit::Microtesla),
        temperature: None,
    };
    let changes = [Some(accel), Some(gyro), field];
    Part::of_each(changes, ["2", "3", "4", "5"], stated).collect()
}

fn get_sensor_data(look: &Look) -> Option<Vec<Part>> {
    if !begins(look, &["ACCE;", "GYRO;", "% ACCE", "%ACCE"]) {
        return None;
    }
    let field: Change = |text| only(text, b"MAGN;");
    Some(stamped(
        |text| only(text, b"ACCE;"),
        |text| only(text, b"GYRO;"),
        begins(look, &["MAGN;"]).then_some(field),
        TimeUnit::Seconds,
    ))
}

fn gnss_logger(look: &Look) -> Option<Vec<Part>> {
    if begins(look, &["UncalAccel,", "UncalGyro,", "# UncalAccel,"]) {
        let field: Change = |text| only(text, b"UncalMag,");
        return Some(stamped(
            |text| only(text, b"UncalAccel,"),
            |text| only(text, b"UncalGyro,"),
            begins(look, &["UncalMag,"]).then_some(field),
            TimeUnit::Nanoseconds,
        ));
    }
    // Two stamps stand before the axes.
    let is_whole = |line: &str| line.starts_with("Accel,") && line.split(',').count() >= 6;
    (begins(look, &["# Accel,"]) || look.lines().any(is_whole)).then(|| {
        stamped(
            |text| only(text, b"Accel,"),
            |text| only(text, b"Gyro,"),
            None,
            TimeUnit::Nanoseconds,
        )
    })
}

/// VectorNav's messages: tag, number of cells before the magnetometer's, true if a temperature follows, and rewriting to rows.
const VECTORNAV_MESSAGES: [(&str, usize, bool, Change); 4] = [
    ("$VNIMU,", 0, true, |text| message(text, b"$VNIMU,")),
    ("$VNMAR,", 0, false, |text| message(text, b"$VNMAR,")),
    ("$VNYMR,", 3, false, |text| message(text, b"$VNYMR,")),
    ("$VNQMR,", 4, false, |text| message(text, b"$VNQMR,")),
];

/// The cells of the messages that begin with `tag`, without their checksum.
fn message(text: Box<dyn Read + Send>, tag: &'static [u8]) -> Box<dyn Read + Send> {
    rewritten(text, move |line, out| {
        if let Some(rest) = line.strip_prefix(tag) {
            out.extend(rest.iter().take_while(|byte| **byte != b'*'));
        }
    })
}

fn vectornav(look: &Look) -> Option<Vec<Part>> {
    let mut messages = VECTORNAV_MESSAGES.into_iter();
    let (_, before, thermometer, change) = messages.find(|(tag, ..)| begins(look, &[tag]))?;
    let axes = |axis: usize| {
        [
            (Role::Accel(axis), (before + axis + 4).to_string()),
            (Role::Gyro(axis), (before + axis + 7).to_string()),
            (Role::Field(axis), (before + axis + 1).to_string()),
        ]
    };
    let temperature = thermometer.then(|| (Role::Temperature, "10".to_owned()));
    Some(vec![Part {
        columns: (0..3).flat_map(axes).chain(temperature).collect(),
        accel_unit: Some(AccelUnit::MetresPerSecondSquared),
        gyro_unit: Some(GyroUnit::RadiansPerSecond),
        field_unit: Some(FieldUnit::Gauss),
        change: Some(change),
        ..Part::default()
    }])
}
