//! Orientation, time and recording of a static interval.

use nalgebra::Vector3;

/// A static interval as the tests of its orientation see it.
#[derive(Clone, Copy, Debug)]
pub struct Oriented {
    /// Direction of specific force, body frame.
    pub direction: Vector3<f64>,
    /// Sign of the last change of its components.
    pub last_change: Vector3<f64>,
    /// Middle, s since the reference time of its recording.
    pub time: f64,
    /// Its recording.
    pub recording: usize,
}
