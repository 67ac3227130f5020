//! The static intervals as the hypotheses see them.

use recording::intervals::{Moments, Span};

/// A static interval by its means.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    /// Its number, from 0.
    pub place: usize,
    /// From, to.
    pub span: Span,
    /// Of the accelerometer.
    pub force: Option<Moments>,
    /// Of the gyroscope.
    pub rate: Option<Moments>,
}
