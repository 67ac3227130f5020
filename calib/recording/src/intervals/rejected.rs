//! Quiet stretches that are no static intervals.

use std::fmt;

use super::spans::Span;

/// A quiet stretch that is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// When.
    pub span: Span,
    /// Why it is no static interval.
    pub reason: Reason,
}

/// Why a quiet stretch is no static interval.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// The device turned about the vertical at this rate, rad/s, which no bias explains.
    Turning(f64),
    /// The accelerometer is cut off at the end of its range on this axis, 0 to 2.
    Clipped(usize),
    /// The device tilted steadily, from begin to end by this angle, rad.
    Tilting(f64),
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Span { from, to } = self.span;
        write!(
            f,
            "the quiet stretch from {from:.2} to {to:.2} s is no static interval: "
        )?;
        match self.reason {
            Reason::Turning(rate) => write!(
                f,
                "the gyroscope's mean there is that of a turn about the vertical at {:.2} °/s, which no \
                 bias explains; lay the device down where nothing turns",
                rate.to_degrees().abs()
            ),
            Reason::Clipped(axis) => write!(
                f,
                "accelerometer {} is cut off at the end of its range; set a larger range",
                ["x", "y", "z"].get(axis).copied().unwrap_or_default()
            ),
            Reason::Tilting(angle) => write!(
                f,
                "the device tilts steadily, by a slope of {:.3} °/s and {:.2}° in all; lay it down on something \
                 firm",
                angle.to_degrees() / self.span.length(),
                angle.to_degrees()
            ),
        }
    }
}
