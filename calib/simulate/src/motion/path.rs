//! A motion while it is being put together.

use nalgebra::{UnitQuaternion, Vector3};

use super::segment::{Move, Rest, Segment, Twist};

/// Segments end to end: each begins where the one before it has come to rest.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    segments: Vec<Segment>,
    attitude: UnitQuaternion<f64>,
    position: Vector3<f64>,
    end: f64,
}

impl Path {
    /// An empty path that begins at time 0 with this attitude (body to reference).
    pub fn starting_at(attitude: UnitQuaternion<f64>) -> Self {
        Self {
            segments: Vec::new(),
            attitude,
            position: Vector3::zeros(),
            end: 0.0,
        }
    }

    /// Returns the time at which the next segment begins, s.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Attitude at the end, body to reference.
    pub fn attitude(&self) -> UnitQuaternion<f64> {
        self.attitude
    }

    /// Appends `length` seconds at a placement; `twists` and `moves` disturb it.
    pub fn rest(&mut self, length: f64, rest: Rest, twists: Vec<Twist>, moves: Vec<Move>) {
        self.push(length, twists, moves, Some(rest));
    }

    /// Appends `length` seconds of motion.
    pub fn movement(&mut self, length: f64, twists: Vec<Twist>, moves: Vec<Move>) {
        self.push(length, twists, moves, None);
    }

    /// The segments; one empty rest if there are none, so that a motion is never without.
    pub fn into_segments(mut self) -> Vec<Segment> {
        if self.segments.is_empty() {
            self.push(0.0, Vec::new(), Vec::new(), None);
        }
        self.segments
    }

    fn push(&mut self, length: f64, twists: Vec<Twist>, moves: Vec<Move>, rest: Option<Rest>) {
        let start = self.end;
        let end = start + length;
        let (attitude, position) = (self.attitude, self.position);
        let segment = Segment {
            start,
            end,
            attitude,
            position,
            twists,
            moves,
            rest,
        };
        let last = segment.at(end);
        self.attitude = UnitQuaternion::new_normalize(last.attitude.into_inner());
        self.position = last.position;
        self.end = end;
        self.segments.push(segment);
    }
}
