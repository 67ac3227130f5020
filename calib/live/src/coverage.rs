//! What the placements so far tell, and which one tells most next.
//!
//! A placement `u` (unit vector that points up) gives one equation `‖T (A - b)‖ = g`. Its derivatives with respect to the
//! nine parameters of the accelerometer are, near a perfect sensor, combinations of
//! `h(u) = (u_x², u_y², u_z², √2 u_x u_y, √2 u_x u_z, √2 u_y u_z, u_x, u_y, u_z)`, so that `M = Σ h hᵀ` is the information
//! of equally good placements up to a fixed change of basis, and `det M` does not care which (Atkinson, Donev and Tobias,
//! Optimum experimental designs with SAS, 2007, chapter 11: D-optimality).

use nalgebra::{SMatrix, SVector, Vector3};

use crate::direction::Direction;

type Feature = SVector<f64, 9>;
type Information = SMatrix<f64, 9, 9>;

/// What is known beforehand, in units of one placement: keeps the first determinants from being zero and is nothing
/// beside nine placements.
const BEFOREHAND: f64 = 1e-3;

/// Placements that tell so much of the best are as good; of them the one whose turn is nearest to a right angle is wanted:
/// a gyroscope sees the axis of a half turn badly and little of a small one.
const AS_GOOD: f64 = 0.9;

fn feature(up: &Vector3<f64>) -> Feature {
    let (x, y, z) = (up.x, up.y, up.z);
    let root = std::f64::consts::SQRT_2;
    Feature::from([
        x * x,
        y * y,
        z * z,
        root * x * y,
        root * x * z,
        root * y * z,
        x,
        y,
        z,
    ])
}

fn information(covered: &[Vector3<f64>]) -> Information {
    let all = covered.iter().map(feature);
    all.fold(Information::identity() * BEFOREHAND, |m, h| {
        m + h * h.transpose()
    })
}

/// What one more placement tells: `hᵀ M⁻¹ h`, the variance of its prediction by those before.
fn gain(information: &Information, up: &Vector3<f64>) -> f64 {
    let h = feature(up);
    let solved = information.cholesky().map(|c| c.solve(&h));
    solved.map_or(f64::INFINITY, |s| h.dot(&s))
}

/// The placement that tells most, after `covered`, of a device that points `now` up.
///
/// # Examples
/// ```
/// use nalgebra::Vector3;
/// let next = live::next_direction(&[Vector3::z()], Some(&Vector3::z()));
/// assert!(next.unit().z.abs() < 0.9, "not the same face again");
/// ```
pub fn next_direction(covered: &[Vector3<f64>], now: Option<&Vector3<f64>>) -> Direction {
    let information = information(covered);
    let all = Direction::all();
    let gains: Vec<f64> = all.iter().map(|d| gain(&information, &d.unit())).collect();
    let best = gains.iter().fold(0.0, |a: f64, b| a.max(*b));
    // How far from a right angle, then simple placements first, which the order of all is.
    let turn = |d: &Direction| now.map_or(0.0, |now| d.unit().dot(now).abs());
    let good = all
        .iter()
        .zip(&gains)
        .filter(|(_, gain)| **gain >= AS_GOOD * best);
    let wanted = good.min_by(|a, b| {
        (a.0.axes(), turn(a.0))
            .partial_cmp(&(b.0.axes(), turn(b.0)))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    wanted.map_or(Direction { signs: [0, 0, 1] }, |(d, _)| *d)
}

/// What a placement at `up` tells as a share of what `wanted` would, 1 for equally much.
pub(crate) fn worth(covered: &[Vector3<f64>], up: &Vector3<f64>, wanted: &Direction) -> f64 {
    let information = information(covered);
    gain(&information, up) / gain(&information, &wanted.unit())
}

/// How much the placements so far tell of what a plan of `planned` placements would: the ninth root of the ratio of
/// determinants (D-efficiency), 1 for as much.
pub fn efficiency(covered: &[Vector3<f64>], planned: usize) -> f64 {
    let log = |ups: &[Vector3<f64>]| {
        information(ups)
            .cholesky()
            .map_or(f64::NEG_INFINITY, |c| c.ln_determinant())
    };
    ((log(covered) - log(&plan(planned))) / 9.0).exp()
}

/// The directions that a person would be asked for who does everything as asked.
fn plan(count: usize) -> Vec<Vector3<f64>> {
    let mut ups: Vec<Vector3<f64>> = Vec::with_capacity(count);
    for _ in 0..count {
        let next = next_direction(&ups, ups.last());
        ups.push(next.unit());
    }
    ups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_nine_placements_determine_all_nine_parameters() {
        let ups = plan(9);
        let bare = information(&ups) - Information::identity() * BEFOREHAND;
        let eigen = bare.symmetric_eigenvalues();
        assert!(eigen.min() > 0.05, "{eigen}");
        assert!((efficiency(&ups, 9) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn placements_in_one_plane_are_worth_nothing_however_many() {
        let ring: Vec<_> = (0..24)
            .map(|k| (0.26 * f64::from(k)).sin_cos())
            .map(|(s, c)| Vector3::new(c, s, 0.0))
            .collect();
        assert!(efficiency(&ring, 12) < 0.1);
        let next = next_direction(&ring, None);
        assert!(next.signs[2] != 0, "{next:?}");
    }

    #[test]
    fn the_same_placement_again_is_worth_less_than_half_of_what_is_wanted() {
        let ups = plan(6);
        let wanted = next_direction(&ups, ups.last());
        assert!(ups.iter().all(|up| worth(&ups, up, &wanted) < 0.5));
    }
}
