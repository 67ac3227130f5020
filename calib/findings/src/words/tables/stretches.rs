//! Words of quiet stretches that are no static intervals, and of turns that cannot be integrated.

use crate::kind::Kind;
use crate::words::entry::{Entry, remark};

/// What to do about a turn that cannot be integrated.
const TURN_LEFT_OUT: &str =
    "nothing has to be done while the device turns about each axis both ways in the others";

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::StretchTurns => Entry {
            reason: "a quiet stretch turns at a constant rate",
            text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: the device turned at a constant rate[ of {rate}], which no bias explains",
            advice: "nothing has to be done while ten static intervals are left; else lay the device down where nothing turns",
            ..remark(0.02)
        },
        Kind::StretchClipped => Entry {
            reason: "the accelerometer is cut off in a quiet stretch",
            text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: accelerometer {axis} is cut off at the end of its range",
            advice: "nothing has to be done while ten static intervals are left; else record with a larger range of the sensor",
            ..remark(0.02)
        },
        Kind::StretchTilts => Entry {
            reason: "the device tilts in a quiet stretch",
            text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: the device tilts[, by a slope of {slope} and {angle} in all]",
            advice: "nothing has to be done while ten static intervals are left; else lay it down on something firm",
            ..remark(0.02)
        },
        Kind::StretchVibrates => Entry {
            reason: "the device vibrates in a quiet stretch",
            text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: a machine or a hand shook the device there, and the program does not use it",
            advice: "nothing has to be done while ten static intervals are left; else lay it down where no machine runs",
            ..remark(0.02)
        },
        Kind::StretchEmpty => Entry {
            reason: "a sensor has no samples in a quiet stretch",
            text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: a sensor has no samples in that time",
            advice: "nothing has to be done while ten static intervals are left; else give stretches in which all sensors were recorded",
            ..remark(0.02)
        },
        Kind::TurnGap => Entry {
            reason: "samples are missing in a turn",
            text: "samples are missing for {length} s of this turn, from t = {start} on",
            advice: TURN_LEFT_OUT,
            ..remark(0.02)
        },
        Kind::TurnFrozen => Entry {
            reason: "the gyroscope is frozen in a turn",
            text: "the gyroscope repeated one reading for {length} s of this turn, from t = {start} on",
            advice: TURN_LEFT_OUT,
            ..remark(0.02)
        },
        Kind::TurnSaturated => Entry {
            reason: "the gyroscope is saturated in a turn",
            text: "the gyroscope reached the end of its range in this turn ({samples:sample})",
            advice: TURN_LEFT_OUT,
            ..remark(0.02)
        },
        Kind::TurnEmpty => Entry {
            reason: "a turn has no samples",
            text: "the gyroscope has no samples in this turn",
            advice: TURN_LEFT_OUT,
            ..remark(0.02)
        },
        _ => return None,
    })
}
