//! Words of units and gravity that cannot be right.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::UnitUnknown,
        "this unit is unknown; known: {known}",
        "choose one of these",
        Vec::new,
    ),
    Entry::error(
        Kind::GravityOfNoUnit,
        "at rest the accelerometer's readings have the length {radius}, which is gravity in no unit that the program knows",
        "",
        || {
            vec![Remedy::examples([
                (OptionName::AccelUnit, "m/s^2"),
                (OptionName::AccelUnit, "counts"),
            ])]
        },
    ),
    Entry::error(
        Kind::UnitStrange,
        "the file states {unit} for the {sensor}, which is no known unit, and the readings do not tell their unit either",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::GravityRemoved,
        "the accelerometer's readings have a median length of {norm} {unit}: gravity has been removed, and calibration needs it",
        "record the accelerometer with gravity (\"total\", \"uncalibrated\" or \"with g\")",
        Vec::new,
    ),
    Entry::error(
        Kind::Normalised,
        "the accelerometer's readings have the same length, {length}, in every row, while the device turns too: they were normalised to a direction, and no force is left in them",
        "record the accelerometer before it is normalised (\"raw\" or \"uncalibrated\")",
        Vec::new,
    ),
    Entry::error(
        Kind::GravityInOtherUnit,
        "at rest the accelerometer reads {radius} in all directions, which is gravity in {right}, not in {unit}, as {by} says",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::GravityOff,
        "at rest the accelerometer reads {radius} in all directions, which is {ratio} times gravity in {unit}, as {by} says",
        "",
        || vec![Remedy::set_to(OptionName::AccelUnit, "counts")],
    ),
    Entry::error(
        Kind::TurnsImpossible,
        "the file states {unit} for the gyroscope, and in that unit the device would turn faster than {fastest} again and again",
        "",
        || vec![Remedy::such_as(OptionName::GyroUnit, "counts")],
    ),
    Entry::error(
        Kind::TurnsInOtherUnit,
        "{by} {unit} for the gyroscope, but its turns are those that the accelerometer saw in {told}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TurnsOff,
        "{by} {unit} for the gyroscope, but its turns went about {factor} times as far by what the accelerometer saw: the unit of the gyroscope or of the time stamps is another",
        "",
        || {
            vec![Remedy::examples([
                (OptionName::TimeUnit, "us"),
                (OptionName::GyroUnit, "counts"),
                (OptionName::Columns, "t=NAME"),
            ])]
        },
    ),
    Entry::error(
        Kind::RestlessRest,
        "the gyroscope rests throughout, so that no turn tells its unit. In {unit} its noise would be {noise} and its bias {bias}, as no gyroscope has",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorsSwapped,
        "the columns of the gyroscope turn with gravity from rest to rest, and those of the accelerometer do not: their names are swapped",
        "[give {files} the other way round]",
        Vec::new,
    ),
];
