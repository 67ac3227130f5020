//! Static intervals in a part of the recording that fit another accelerometer than those of the multiplier that was chosen.

use findings::{Finding, Kind};
use recording::intervals::Span;

/// A part of a recording that fits another accelerometer.
#[derive(Clone, Debug, PartialEq)]
pub struct OfAnother {
    /// From its first static interval to its last.
    pub span: Span,
    /// Number of static intervals in it.
    pub intervals: usize,
    /// Number of those that are used instead.
    pub used: usize,
    /// By how much the accelerometer of the others misses gravity in it, root mean square, m/s².
    pub missed: f64,
    /// The same of an accelerometer of its own, per degree of freedom.
    pub own: f64,
}

impl OfAnother {
    /// The same as a finding.
    pub fn finding(&self) -> Finding {
        Finding::of(Kind::OF_ANOTHER_ACCELEROMETER)
            .between(self.span.from, self.span.to)
            .count("intervals", self.intervals)
            .count("used", self.used)
            .number("missed", self.missed, "m/s^2")
            .number("own", self.own, "m/s^2")
    }
}
