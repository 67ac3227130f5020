//! Rows in which a sensor repeated one reading.

use sensor::Sensor;

use crate::intervals::Span;

/// A sensor's readings that repeat one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frozen {
    /// The sensor.
    pub sensor: Sensor,
    /// The first row that repeats the one before, counted as in [`Symptom`](crate::readings::Symptom).
    pub first_row: usize,
    /// Number of rows that repeat it.
    pub rows: usize,
    /// From the reading that is repeated to the next other one, s.
    pub span: Span,
}

impl Frozen {
    /// Returns true if the run lies between two stamps, s: leaving it out makes the interruption there.
    pub fn is_between(&self, from: f64, to: f64) -> bool {
        self.span.from < to && from < self.span.to
    }

    /// Returns true if a sample at `t`, s, is a repetition.
    pub(crate) fn repeats(&self, t: f64) -> bool {
        self.span.from < t && t < self.span.to
    }
}
