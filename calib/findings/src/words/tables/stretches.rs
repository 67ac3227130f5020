//! Words of quiet stretches that are no static intervals, and of turns that cannot be integrated.

use crate::kind::Kind;
use crate::level::Level;
use crate::words::entry::Entry;

/// What to do about a turn that cannot be integrated.
const TURN_LEFT_OUT: &str =
    "nothing has to be done while the device turns about each axis both ways in the others";

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::StretchTurns,
        level: Level::Remark,
        severity: 0.02,
        reason: "a quiet stretch turns at a constant rate",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: the device turned at a constant rate[ of {rate}], which no bias explains",
        advice: "nothing has to be done while ten static intervals are left; else lay the device down where nothing turns",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StretchClipped,
        level: Level::Remark,
        severity: 0.02,
        reason: "the accelerometer is cut off in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: accelerometer {axis} is cut off at the end of its range",
        advice: "nothing has to be done while ten static intervals are left; else record with a larger range of the sensor",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StretchTilts,
        level: Level::Remark,
        severity: 0.02,
        reason: "the device tilts in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: the device tilts[, by a slope of {slope} and {angle} in all]",
        advice: "nothing has to be done while ten static intervals are left; else lay it down on something firm",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StretchVibrates,
        level: Level::Remark,
        severity: 0.02,
        reason: "the device vibrates in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: a machine or a hand shook the device there, and the program does not use it",
        advice: "nothing has to be done while ten static intervals are left; else lay it down where no machine runs",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StretchEmpty,
        level: Level::Remark,
        severity: 0.02,
        reason: "a sensor has no samples in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: a sensor has no samples in that time",
        advice: "nothing has to be done while ten static intervals are left; else give stretches in which all sensors were recorded",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TurnGap,
        level: Level::Remark,
        severity: 0.02,
        reason: "samples are missing in a turn",
        text: "samples are missing for {length} s of this turn, from t = {start} on",
        advice: TURN_LEFT_OUT,
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TurnFrozen,
        level: Level::Remark,
        severity: 0.02,
        reason: "the gyroscope is frozen in a turn",
        text: "the gyroscope repeated one reading for {length} s of this turn, from t = {start} on",
        advice: TURN_LEFT_OUT,
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TurnSaturated,
        level: Level::Remark,
        severity: 0.02,
        reason: "the gyroscope is saturated in a turn",
        text: "the gyroscope reached the end of its range in this turn ({samples:sample})",
        advice: TURN_LEFT_OUT,
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TurnEmpty,
        level: Level::Remark,
        severity: 0.02,
        reason: "a turn has no samples",
        text: "the gyroscope has no samples in this turn",
        advice: TURN_LEFT_OUT,
        remedies: Vec::new,
    },
];
