//! Samples and events as they come.

use std::time::Duration;

use calib::recording::Stream;
use serde::Serialize;

/// Samples and events of one poll.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Specific force, m/s² (or raw counts), stamps later than all before.
    pub accelerometer: Stream,
    /// Angular rate, rad/s (or raw counts), stamps later than all before.
    pub gyroscope: Stream,
    /// Events since the last poll.
    pub events: Vec<Event>,
    /// Additional waiting time before the next poll.
    pub pause: Option<Duration>,
}

/// Event of a source.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "event")]
#[non_exhaustive]
pub enum Event {
    /// The source is there.
    Connected {
        /// Name that the source gives itself.
        name: String,
    },
    /// It measures no more.
    Paused,
    /// It measures again, after so many seconds.
    Resumed {
        /// Length of the pause, s; stamps after it are moved on by that.
        seconds: f64,
    },
    /// It did not answer; the attempt is repeated.
    Reconnecting {
        /// Attempts in a row without an answer.
        attempts: u32,
        /// Error of the last attempt.
        cause: String,
    },
    /// It answers again.
    Reconnected,
    /// Its data were cleared and its clock begins anew; what came before is kept in a file of its own.
    Restarted,
    /// Text comes that is not understood yet.
    NotUnderstood {
        /// Why.
        reason: String,
    },
    /// Nothing comes any more.
    Ended,
}
