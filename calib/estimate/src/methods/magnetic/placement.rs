//! Measurements for the fit: the magnetometer in each static interval, and the change of heading from one to the next.

use nalgebra::{Matrix3, Vector3};
use recording::intervals::Span;
use sensor::Kinematics;

/// A static interval as the magnetometer sees it.
#[derive(Clone, Debug)]
pub struct Placement {
    /// Place of the recording.
    pub recording: usize,
    /// Part with a bias of its own, among those of all recordings.
    pub part: usize,
    /// Place of the static interval in that recording.
    pub interval: usize,
    /// Begin and end by the stamps, s.
    pub span: Span,
    /// Mean reading.
    pub mean: Vector3<f64>,
    /// Standard deviation of an axis of the mean by the noise within, in the unit of the readings.
    pub noise: f64,
    /// Up by the accelerometer, body frame, unit length.
    pub up: Vector3<f64>,
    /// Error of its direction, rad: a small rotation of the level frame in body axes, by each of the errors of the other
    /// sensors (3 each).
    pub tilt: Vec<Vector3<f64>>,
    /// Other inputs of the effects there.
    pub known: Kinematics<f64>,
    /// Mean rate by the calibrated gyroscope, rad/s: what is left of its bias. `None` without one.
    pub rate: Option<Rest>,
    /// True if the reading is used; false where the field is another.
    pub is_used: bool,
}

/// The rate in a static interval.
#[derive(Clone, Copy, Debug)]
pub struct Rest {
    /// Its mean, rad/s.
    pub mean: Vector3<f64>,
    /// Standard deviation of an axis of it by the noise within, rad/s.
    pub noise: f64,
}

/// Rotation of the device about the vertical between two consecutive placements.
#[derive(Clone, Debug)]
pub struct HeadingChange {
    /// Place of the one before in the list of placements; the other is the next.
    pub from: usize,
    /// From the [`Placement::reference`] of the one to that of the other, counter-clockwise seen from above, rad, by the
    /// rate less the mean of both rests.
    pub angle: f64,
    /// Change of the angle per unit by which the rate is too small, rad/(rad/s), body axes.
    pub by_rate: Vector3<f64>,
    /// Change of the angle by each of the errors of the other sensors, rad.
    pub by_error: Vec<f64>,
    /// Standard deviation by the gyroscope's noise, rad.
    pub noise: f64,
}

impl Placement {
    /// The level axes in body axes, as columns: x level, y level, z up. Its x axis is that body axis made level which
    /// lies flattest: an error of the tilt then moves no heading to first order.
    pub fn reference(&self) -> Matrix3<f64> {
        let up = self.up;
        let flattest = up.iamin();
        let axis = Vector3::from_fn(|i, _| if i == flattest { 1.0 } else { 0.0 });
        let x = (axis - up * axis.dot(&up)).normalize();
        Matrix3::from_columns(&[x, up.cross(&x), up])
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub fn at(up: Vector3<f64>, mean: Vector3<f64>) -> Placement {
        Placement {
            recording: 0,
            part: 0,
            interval: 0,
            span: Span { from: 0.0, to: 1.0 },
            mean,
            noise: 0.05,
            up: up.normalize(),
            tilt: Vec::new(),
            known: Kinematics::at_rest(up.normalize() * 9.8),
            rate: None,
            is_used: true,
        }
    }

    #[test]
    fn the_reference_is_a_rotation_with_z_up() {
        let placement = at(Vector3::new(0.2, -0.9, 0.4), Vector3::zeros());
        let axes = placement.reference();
        assert!((axes.transpose() * axes - Matrix3::identity()).norm() < 1e-15);
        assert!((axes.determinant() - 1.0).abs() < 1e-15);
        assert_eq!(axes.column(2), placement.up);
    }
}
