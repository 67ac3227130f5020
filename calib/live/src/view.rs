//! A session at an instant, for the eye and for programs.

use serde::Serialize;

use crate::direction::Direction;
use crate::instruction::{Instruction, Verdict};
use crate::motion::Motion;
use crate::promise::{PROMISE, Promise};
use crate::running::Estimate;
use crate::session::Session;

/// State of a session for a page, a terminal or a log.
#[derive(Clone, Debug, Serialize)]
pub struct View {
    /// Current instruction.
    pub instruction: Instruction,
    /// Current state of motion of the device.
    pub motion: Motion,
    /// Placements so far: direction of specific force and what became of it.
    pub placements: Vec<([f64; 3], Verdict)>,
    /// Placements planned.
    pub planned: usize,
    /// Static time of each placement, s.
    pub hold: f64,
    /// Direction that is requested next.
    pub wanted: Option<Direction>,
    /// Direction of specific force now.
    pub up: Option<[f64; 3]>,
    /// Rotation from the device to the room as w, x, y, z; its heading is free.
    pub attitude: [f64; 4],
    /// Standard errors now.
    pub estimate: Estimate,
    /// The standard errors that the session ends with.
    pub promise: Promise,
    /// Samples of accelerometer and gyroscope.
    pub samples: [usize; 2],
    /// Time since the first sample, s.
    pub seconds: f64,
}

impl View {
    /// Builds the view from the current state of a session.
    pub fn of(session: &Session) -> Self {
        let recording = session.recording();
        let streams = [&recording.accelerometer, &recording.gyroscope].map(Option::as_ref);
        let length = |stream: &calib::recording::Stream| {
            stream.t.first().zip(stream.t.last()).map(|(a, b)| b - a)
        };
        Self {
            instruction: session.instruction(),
            motion: session.motion(),
            placements: session
                .placements()
                .iter()
                .map(|p| (p.up.into(), p.verdict))
                .collect(),
            planned: session.aim().placements,
            hold: session.aim().hold,
            wanted: session.wanted(),
            up: session.up().map(Into::into),
            attitude: session.attitude(),
            estimate: session.estimate().clone(),
            promise: PROMISE,
            samples: streams.map(|s| s.map_or(0, |s| s.len())),
            seconds: streams[0].and_then(length).unwrap_or(0.0),
        }
    }
}
