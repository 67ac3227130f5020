//! Checks of the recorded orientations.

use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use plan::{FORCE_NAMES, force_information};
use recording::Error;

use crate::residuals::StaticMean;

findings::tuning! {
    /// Placements are in one plane where they leave it by less than this share of what they spread in it.
    FLAT: f64 = 3e-3;
    /// Fewer placements always lie near one.
    ENOUGH_FOR_A_PLANE: usize = 9;

    /// More placements that are asked for where only the noise is too large.
    MORE: usize = 2;
}

/// Why placements are refused: what is there, what is not known, the placements to add, the requirement.
pub(in crate::calibrate) fn refusal(directions: &[Vector3<f64>], kind: Kind) -> Finding {
    plan::coverage(directions).or_more(MORE.get()).refusal(kind)
}

findings::tuning! {
    /// Directions nearer than this are the same placement again, rad (4°): what they differ by is a placement that is not
    /// repeated exactly, and shows scale factors and misalignments badly.
    SAME: f64 = 0.07;

    /// A combination of parameters of which the directions show less than this share of the best is open.
    UNSEEN: f64 = 0.02;
}

/// The refusal of so few directions where they leave parameters open however often they are recorded; `None` where they
/// determine all.
pub(in crate::calibrate) fn open_by_directions(directions: &[Vector3<f64>]) -> Option<Finding> {
    let distinct = distinct(directions);
    let seen = force_information(&distinct).symmetric_eigen();
    let least = (UNSEEN.get() * UNSEEN.get()) * seen.eigenvalues.max();
    let open: Vec<&str> = (0..FORCE_NAMES.len())
        .filter(|&k| {
            let vectors = seen.eigenvalues.iter().enumerate();
            let unseen = vectors.filter(|(_, value)| **value <= least);
            let share: f64 = unseen.map(|(j, _)| seen.eigenvectors[(k, j)].powi(2)).sum();
            share > 0.1
        })
        .map(|k| FORCE_NAMES[k])
        .collect();
    (!open.is_empty()).then(|| {
        refusal(directions, Kind::DIRECTIONS_TOO_FEW)
            .count("directions", distinct.len())
            .detail("parameters", open.join(", "))
    })
}

/// Why the raw means of too few directions are refused; `None` where they are enough.
pub(crate) fn few_directions(raw: &[Vector3<f64>]) -> Option<Finding> {
    let directions: Vec<Vector3<f64>> = raw.iter().map(Vector3::normalize).collect();
    open_by_directions(&directions)
}

/// One direction for each placement that was repeated.
fn distinct(directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut all: Vec<Vector3<f64>> = Vec::new();
    for direction in directions {
        if all.iter().all(|other| other.angle(direction) > SAME.get()) {
            all.push(*direction);
        }
    }
    all
}

/// Refuses placements that lie in one plane to within what no fit can use: it would run along what it cannot
/// see until its steps are spent.
///
/// # Errors
/// [`Error::NotEnough`] with the placements to add.
pub fn not_in_one_plane(means: &[Vec<StaticMean>]) -> Result<(), Error> {
    let raw: Vec<Vector3<f64>> = means.iter().flatten().map(|m| m.raw).collect();
    let middle = raw.iter().sum::<Vector3<f64>>() / raw.len().max(1) as f64;
    let scatter: Matrix3<f64> = raw
        .iter()
        .map(|m| (m - middle) * (m - middle).transpose())
        .sum();
    let spread = scatter.symmetric_eigenvalues();
    let flat = spread.min() <= FLAT.get() * FLAT.get() * spread.max();
    if raw.len() <= ENOUGH_FOR_A_PLANE.get() || !flat {
        return Ok(());
    }
    let directions: Vec<Vector3<f64>> = raw.iter().map(Vector3::normalize).collect();
    Err(Error::not_enough(refusal(
        &directions,
        Kind::PLACEMENTS_IN_PLANE,
    )))
}

#[cfg(test)]
mod tests {
    use findings::Front;

    use super::*;

    fn in_plane(normal: Vector3<f64>) -> Vec<Vector3<f64>> {
        let across = normal.cross(&Vector3::new(0.3, 0.8, -0.5)).normalize();
        let other = normal.normalize().cross(&across);
        let at = |k: i32| {
            let (sin, cos) = (0.9 * f64::from(k)).sin_cos();
            across * cos + other * sin
        };
        (0..7).map(at).collect()
    }

    #[test]
    fn six_faces_however_often_leave_the_misalignments_open_and_edges_show_them() {
        let mut tumbled = Vec::new();
        for k in 0..30 {
            let tilt = 0.01 * f64::from(k % 7);
            let faces = [Vector3::x(), Vector3::y(), Vector3::z()];
            let face = faces[k as usize % 3] * if k % 2 == 0 { 1.0 } else { -1.0 };
            tumbled.push((face + Vector3::new(tilt, -tilt, tilt) * 0.5).normalize());
        }
        let open = open_by_directions(&tumbled).unwrap();
        let names = "accel.alpha_yz, accel.alpha_zy, accel.alpha_zx";
        assert_eq!(open.word("parameters"), Some(names));
        let edges = [(1.0, 1.0, 0.0), (1.0, 0.0, 1.0), (0.0, -1.0, 1.0)];
        tumbled.extend(edges.map(|(x, y, z)| Vector3::new(x, y, z).normalize()));
        assert_eq!(open_by_directions(&tumbled), None);
    }

    #[test]
    fn a_plane_asks_for_placements_that_leave_it() {
        for normal in [Vector3::z(), Vector3::new(3.0, 0.0, -4.0)] {
            let there = in_plane(normal);
            let found = plan::coverage(&there);
            let along = |w: &plan::Wanted| Vector3::from(w.up).dot(&normal.normalize()).abs();
            let leaves = found.wanted.iter().filter(|w| along(w) > 0.5).count();
            assert!(leaves >= 2, "{}", found.advice());
        }
    }

    #[test]
    fn a_refusal_names_what_is_not_known_the_requirement_and_the_placements() {
        let found = refusal(&in_plane(Vector3::z()), Kind::PLACEMENTS_LEAVE_OPEN)
            .detail("parameters", "accel.s_z")
            .count("rank", 8)
            .count("free", 9);
        let words = found.to_string();
        assert!(words.starts_with(
            "7 placements, 7 of which differ by more than 20°: they determine only 8 of the accelerometer's 9 unknowns: accel.s_z cannot be found"
        ));
        assert!(words.contains(&plan::REQUIREMENT.to_string()), "{words}");
        let advice = found.advice(Front::Plain).unwrap();
        assert!(
            advice.starts_with("add 3 placements: 1) ") || advice.starts_with("add 4"),
            "{words}"
        );
    }
}
