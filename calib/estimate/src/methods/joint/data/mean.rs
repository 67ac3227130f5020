//! The mean of a sensor over a part of a static interval.

use nalgebra::Vector3;
use recording::intervals::Span;

/// The mean of the samples of a sensor over a chunk, near SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// From the begin of the first sample's window to the end of the last, s.
    pub span: Span,
    /// Number of samples.
    pub count: usize,
    /// Their mean (3).
    pub value: Vector3<f64>,
    /// Their variance (3).
    pub variance: Vector3<f64>,
    /// Their slope, per second (3).
    pub slope: Vector3<f64>,
    /// `Σ (t − t̄)²`, s²: the slope has the variance `σ²` over this.
    pub spread: f64,
}
