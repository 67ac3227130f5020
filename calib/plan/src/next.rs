//! One placement more, while a session goes on.

use nalgebra::Vector3;

use crate::accelerometer::{ForceMatrix, force_information, force_row};
use crate::direction::faces_edges_corners;
use crate::exchange::{Criterion, gain};

findings::tuning! {
    /// Prior information, in units of one placement. It keeps the first determinants from being zero and is negligible
    /// after nine placements.
    BEFOREHAND: f64 = 1e-3;

    /// Placements that tell so much of the best are as good; of them the one whose turn is nearest to a right angle is wanted:
    /// a gyroscope sees the axis of a half turn badly and little of a small one.
    AS_GOOD: f64 = 0.9;
}

/// Placements beside what is known beforehand, which favours no direction: `u_i u_j` counts twice off the diagonal of `u uᵀ`.
fn information(covered: &[Vector3<f64>]) -> ForceMatrix {
    let mut before = ForceMatrix::identity() * BEFOREHAND.get();
    for k in 3..6 {
        before[(k, k)] *= 0.5;
    }
    before + force_information(covered)
}

/// By how much a placement after `covered` lowers the volume of what is not known: `hᵀ M⁻¹ h`.
fn told_after(covered: &[Vector3<f64>]) -> impl Fn(&Vector3<f64>) -> f64 {
    let covariance = information(covered).cholesky().map(|c| c.inverse());
    move |up| {
        covariance.map_or(f64::INFINITY, |c| {
            gain(&force_row(up), &c, Criterion::Volume)
        })
    }
}

/// The face, edge or corner that tells most after `covered`, of a device that points `now` up: the simplest that is nearly
/// as good as the best.
///
/// ```
/// use nalgebra::Vector3;
///
/// let next = stillpoint_plan::next_placement(&[Vector3::z()], Some(&Vector3::z()));
/// assert!(next.z.abs() < 0.9, "not the same face again");
/// ```
pub fn next_placement(covered: &[Vector3<f64>], now: Option<&Vector3<f64>>) -> Vector3<f64> {
    let all = faces_edges_corners();
    let gains: Vec<f64> = all.iter().map(told_after(covered)).collect();
    let best = gains.iter().fold(0.0, |a: f64, b| a.max(*b));
    let axes = |up: &Vector3<f64>| up.iter().filter(|c| c.abs() > 1e-9).count();
    // How far from a right angle; of equal ones the screen's and the back's first.
    let turn = |up: &Vector3<f64>| now.map_or(0.0, |now| up.dot(now).abs());
    let ease = |up: &Vector3<f64>| (axes(up), turn(up), -up.z);
    let good = all
        .iter()
        .zip(&gains)
        .filter(|(_, gain)| **gain >= AS_GOOD.get() * best)
        .map(|(up, _)| *up);
    let order = |a: &Vector3<f64>, b: &Vector3<f64>| {
        let compared = ease(a).partial_cmp(&ease(b));
        compared.unwrap_or(std::cmp::Ordering::Equal)
    };
    good.min_by(order).unwrap_or_else(Vector3::z)
}

/// Returns the information gain of a placement at `up` relative to that of `wanted`; 1 for an equal gain.
pub fn worth(covered: &[Vector3<f64>], up: &Vector3<f64>, wanted: &Vector3<f64>) -> f64 {
    let told = told_after(covered);
    told(up) / told(wanted)
}

/// Returns the D-efficiency of the placements relative to a session of `planned` placements that follows every
/// [`next_placement`]: the ninth root of the ratio of determinants, 1 for equal information.
pub fn session_efficiency(covered: &[Vector3<f64>], planned: usize) -> f64 {
    let log = |ups: &[Vector3<f64>]| {
        let factor = information(ups).cholesky();
        factor.map_or(f64::NEG_INFINITY, |c| c.ln_determinant())
    };
    let count = crate::accelerometer::FORCE_PARAMETERS as f64;
    ((log(covered) - log(&obedient(planned))) / count).exp()
}

/// The placements of a person who does everything as asked.
fn obedient(count: usize) -> Vec<Vector3<f64>> {
    let mut ups: Vec<Vector3<f64>> = Vec::with_capacity(count);
    for _ in 0..count {
        ups.push(next_placement(&ups, ups.last()));
    }
    ups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_nine_placements_determine_all_nine_parameters() {
        let ups = obedient(9);
        let eigen = force_information(&ups).symmetric_eigenvalues();
        assert!(eigen.min() > 0.05, "{eigen}");
        assert!((session_efficiency(&ups, 9) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn placements_in_one_plane_are_worth_nothing_however_many() {
        let ring: Vec<_> = (0..24)
            .map(|k| (0.26 * f64::from(k)).sin_cos())
            .map(|(s, c)| Vector3::new(c, s, 0.0))
            .collect();
        assert!(session_efficiency(&ring, 12) < 0.1);
        let next = next_placement(&ring, None);
        assert!(next.z != 0.0, "{next:?}");
    }

    #[test]
    fn the_same_placement_again_is_worth_less_than_half_of_what_is_wanted() {
        let ups = obedient(6);
        let wanted = next_placement(&ups, ups.last());
        assert!(ups.iter().all(|up| worth(&ups, up, &wanted) < 0.5));
    }
}
