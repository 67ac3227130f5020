//! Assumptions about the end of a motion, and the corrections that they give.

use nalgebra::Vector3;
use sensor::attitude::Attitude;

/// Assumption about the end of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ending {
    /// Nothing.
    Free,
    /// At rest: the velocity there is an error that grew with time, and is taken off in proportion.
    Velocity,
    /// At rest, and gravity shows which way is up: the tilt of the attitude there is an error that
    /// grew with time as well.
    #[default]
    Attitude,
}

/// The rotation vector (rad) that carries `from` onto `to`, the shorter way.
pub(super) fn shortest_rotation(from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    let axis = from.cross(to);
    let (sin, cos) = (axis.norm(), from.dot(to));
    if sin > 0.0 {
        axis * (sin.atan2(cos) / sin)
    } else {
        Vector3::zeros()
    }
}

/// Turns every attitude about a fixed axis, in proportion to the share of the time elapsed, so that
/// the last one carries `resting` (body frame) onto `up`. Returns the whole angle, rad.
pub(super) fn level_the_end(
    attitudes: &mut [Attitude<f64>],
    share: &[f64],
    resting: &Vector3<f64>,
    up: &Vector3<f64>,
) -> f64 {
    let Some(last) = attitudes.last() else {
        return 0.0;
    };
    let tilt = shortest_rotation(&last.into_reference(resting), up);
    for (attitude, share) in attitudes.iter_mut().zip(share) {
        *attitude = Attitude::exp(&(tilt * *share)).then(attitude);
    }
    tilt.norm()
}

/// Takes the last velocity off in proportion to the share of the time elapsed.
pub(super) fn stop_at_the_end(velocity: &mut [Vector3<f64>], share: &[f64]) {
    let Some(&last) = velocity.last() else {
        return;
    };
    for (v, share) in velocity.iter_mut().zip(share) {
        *v -= last * *share;
    }
}
