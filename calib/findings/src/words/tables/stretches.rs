//! Words of quiet stretches that are no static intervals, and of turns that cannot be integrated.

use crate::words::entry::{Entry, remark};

/// What to do about a turn that cannot be integrated.
const TURN_LEFT_OUT: &str =
    "nothing has to be done while the device turns about each axis both ways in the others";

kinds! {
    /// The device turned at a constant rate in a quiet stretch.
    STRETCH_TURNS = "stretch_turns" => Entry {
        reason: "a quiet stretch turns at a constant rate",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: the device turned at a constant rate[ of {rate}], which no bias explains",
        advice: "nothing has to be done while ten static intervals are left; else lay the device down where nothing turns",
        ..remark(0.02)
    },
    /// The accelerometer is cut off in a quiet stretch.
    STRETCH_CLIPPED = "stretch_clipped" => Entry {
        reason: "the accelerometer is cut off in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: accelerometer {axis} is cut off at the end of its range",
        advice: "nothing has to be done while ten static intervals are left; else record with a larger range of the sensor",
        ..remark(0.02)
    },
    /// The device tilts steadily in a quiet stretch.
    STRETCH_TILTS = "stretch_tilts" => Entry {
        reason: "the device tilts in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: the device tilts[, by a slope of {slope} and {angle} in all]",
        advice: "nothing has to be done while ten static intervals are left; else lay it down on something firm",
        ..remark(0.02)
    },
    /// The device vibrates in a quiet stretch.
    STRETCH_VIBRATES = "stretch_vibrates" => Entry {
        reason: "the device vibrates in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: a machine or a hand shook the device there, and the program does not use it",
        advice: "nothing has to be done while ten static intervals are left; else lay it down where no machine runs",
        ..remark(0.02)
    },
    /// A sensor has no samples in a quiet stretch.
    STRETCH_EMPTY = "stretch_empty" => Entry {
        reason: "a sensor has no samples in a quiet stretch",
        text: "[the quiet stretch at {at} is no static interval][{count} quiet stretches are no static intervals ({listed})]: a sensor has no samples in that time",
        advice: "nothing has to be done while ten static intervals are left; else give stretches in which all sensors were recorded",
        ..remark(0.02)
    },
    /// Samples are missing in a turn.
    TURN_GAP = "turn_gap" => Entry {
        reason: "samples are missing in a turn",
        text: "samples are missing for {length} s of this turn, from t = {start} on",
        advice: TURN_LEFT_OUT,
        ..remark(0.02)
    },
    /// The gyroscope repeats one reading in a turn.
    TURN_FROZEN = "turn_frozen" => Entry {
        reason: "the gyroscope is frozen in a turn",
        text: "the gyroscope repeated one reading for {length} s of this turn, from t = {start} on",
        advice: TURN_LEFT_OUT,
        ..remark(0.02)
    },
    /// The gyroscope is saturated in a turn.
    TURN_SATURATED = "turn_saturated" => Entry {
        reason: "the gyroscope is saturated in a turn",
        text: "the gyroscope reached the end of its range in this turn ({samples:sample})",
        advice: TURN_LEFT_OUT,
        ..remark(0.02)
    },
    /// A turn has no samples.
    TURN_EMPTY = "turn_empty" => Entry {
        reason: "a turn has no samples",
        text: "the gyroscope has no samples in this turn",
        advice: TURN_LEFT_OUT,
        ..remark(0.02)
    },
}
