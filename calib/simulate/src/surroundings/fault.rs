//! Faults of a recording, as opposed to a sensor.

use serde::{Deserialize, Serialize};

/// A fault of the recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Fault {
    /// The device creeps through a small angle while it should rest.
    Slip {
        /// Placement, counted from 0.
        interval: usize,
        /// Angle from the begin to the end of the placement, rad.
        angle: f64,
    },
    /// Someone touches the device: a 5 Hz shake of at most a second.
    Touch {
        /// Placement, counted from 0.
        interval: usize,
        /// Peak acceleration, m/s².
        size: f64,
    },
    /// A constant extra specific force through the whole placement.
    Disturbed {
        /// Placement, counted from 0.
        interval: usize,
        /// Its size, m/s².
        size: f64,
    },
    /// Samples are lost from both sensors.
    Gap {
        /// True time of the first lost sample, s.
        start: f64,
        /// s.
        length: f64,
    },
    /// Samples of both sensors are lost in the middle of a turn, and the stamps after them are closed
    /// up as if nothing were missing.
    Lost {
        /// Turn, counted from 0.
        turn: usize,
        /// Time that is lost, s.
        length: f64,
    },
    /// The clock of the device runs fast from a moment on.
    ClockChange {
        /// True time, s.
        start: f64,
        /// By this share.
        rate_error: f64,
    },
}
