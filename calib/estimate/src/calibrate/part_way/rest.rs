//! The static intervals as the hypotheses see them.

use recording::intervals::{Moments, Span};

/// A static interval by its means.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    /// Its number, from 0.
    pub place: usize,
    /// From, to.
    pub span: Span,
    /// Mean and covariance of the accelerometer's readings.
    pub force: Option<Moments>,
    /// Mean and covariance of the gyroscope's readings.
    pub rate: Option<Moments>,
}
