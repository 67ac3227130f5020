//! Which orientations were recorded.

use nalgebra::{Matrix3, Vector3};

use crate::error::Error;
use crate::residuals::StaticMean;

/// Orientations closer than this count as one, cos 20°.
const SAME_ORIENTATION: f64 = 0.939_692_620_785_908_4;

/// A face counts as recorded by a placement within 45° of it.
const FACE_REACHED: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Orientations all within this of one plane leave what lies along its normal unknown, sin 20°.
const IN_ONE_PLANE: f64 = 0.342_020_143_325_668_7;

/// Placements are in one plane where they leave it by less than this share of what they spread in it.
const FLAT: f64 = 3e-3;
/// Fewer placements always lie near one.
const ENOUGH_FOR_A_PLANE: usize = 9;

/// A component of a normal below this is rounded away, so that an axis is called by its name.
const ALONG_AN_AXIS: f64 = 0.17;

/// `26 placements, 24 of which differ by more than 20°; add placements with z down`.
pub(super) fn coverage(directions: &[Vector3<f64>]) -> Coverage {
    let mut distinct: Vec<Vector3<f64>> = Vec::new();
    for u in directions {
        if distinct.iter().all(|d| d.dot(u) < SAME_ORIENTATION) {
            distinct.push(*u);
        }
    }
    let faces = ["x up", "x down", "y up", "y down", "z up", "z down"];
    let missing: Vec<&str> = faces
        .iter()
        .enumerate()
        .filter(|(k, _)| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            directions.iter().all(|u| sign * u[k / 2] < FACE_REACHED)
        })
        .map(|(_, face)| *face)
        .collect();
    let mut words = format!(
        "{} placements, {} of which differ by more than 20°",
        directions.len(),
        distinct.len()
    );
    let normal = normal_of_one_plane(directions);
    if let Some(normal) = normal.filter(|n| n.amax() < 1.0) {
        let along = in_words(&normal);
        words.push_str(&format!(
            ", all near one plane; add placements with {along} up and down"
        ));
    } else if !missing.is_empty() {
        words.push_str(&format!("; add placements with {}", missing.join(", ")));
    }
    Coverage {
        words,
        complete: missing.is_empty() && normal.is_none(),
    }
}

/// Refuses placements that lie in one plane to within what no fit can use: it would run along what it cannot
/// see until its steps are spent.
///
/// # Errors
/// [`Error::NotEnough`] with the placements to add.
pub(in crate::calibrate) fn not_in_one_plane(means: &[Vec<StaticMean>]) -> Result<(), Error> {
    let raw: Vec<Vector3<f64>> = means.iter().flatten().map(|m| m.raw).collect();
    let middle = raw.iter().sum::<Vector3<f64>>() / raw.len().max(1) as f64;
    let scatter: Matrix3<f64> = raw
        .iter()
        .map(|m| (m - middle) * (m - middle).transpose())
        .sum();
    let spread = scatter.symmetric_eigenvalues();
    let flat = spread.min() <= FLAT * FLAT * spread.max();
    if raw.len() <= ENOUGH_FOR_A_PLANE || !flat {
        return Ok(());
    }
    let directions: Vec<Vector3<f64>> = raw.iter().map(Vector3::normalize).collect();
    Err(Error::NotEnough(format!(
        "{}: what lies across their plane is not observable",
        coverage(&directions).words
    )))
}

/// The normal of the plane that all directions lie near, to two digits.
fn normal_of_one_plane(directions: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let scatter: Matrix3<f64> = directions.iter().map(|u| u * u.transpose()).sum();
    let eigen = scatter.symmetric_eigen();
    let normal = eigen
        .eigenvectors
        .column(eigen.eigenvalues.imin())
        .into_owned();
    let near = directions
        .iter()
        .all(|u| u.dot(&normal).abs() < IN_ONE_PLANE);
    let rounded = normal.map(|v| if v.abs() < ALONG_AN_AXIS { 0.0 } else { v });
    let upwards = if rounded.sum() < 0.0 {
        -rounded
    } else {
        rounded
    };
    (near && !directions.is_empty())
        .then(|| upwards.normalize().map(|v| (100.0 * v).round() / 100.0))
}

/// `the direction 0.71 x - 0.71 y`.
fn in_words(v: &Vector3<f64>) -> String {
    let parts = v.iter().zip(["x", "y", "z"]).filter(|(c, _)| **c != 0.0);
    parts.fold("the direction".into(), |words: String, (c, axis)| {
        let sign = match (words == "the direction", *c < 0.0) {
            (true, true) => " -",
            (true, false) => " ",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        format!("{words}{sign}{:.2} {axis}", c.abs())
    })
}

/// Which orientations were recorded.
pub(super) struct Coverage {
    pub words: String,
    /// Every face was up and down at least once.
    pub complete: bool,
}

#[cfg(test)]
mod tests {
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
    fn a_plane_across_an_axis_asks_for_both_of_its_faces() {
        let found = coverage(&in_plane(Vector3::z()));
        assert!(!found.complete);
        let asked = found.words.ends_with("add placements with z up, z down");
        assert!(asked, "{}", found.words);
    }

    #[test]
    fn a_slanting_plane_asks_for_its_normal() {
        let found = coverage(&in_plane(Vector3::new(3.0, 0.0, -4.0)));
        let wanted = "all near one plane; add placements with the direction";
        assert!(found.words.contains(wanted), "{}", found.words);
        let slanted = found.words.contains("0.60 x") && found.words.contains("0.80 z");
        assert!(slanted && !found.words.contains(" y"), "{}", found.words);
    }

    #[test]
    fn six_faces_and_an_edge_ask_for_nothing() {
        let mut all: Vec<_> = (0..3)
            .flat_map(|k| [Vector3::ith(k, 1.0), Vector3::ith(k, -1.0)])
            .collect();
        all.push(Vector3::new(1.0, 1.0, 0.0).normalize());
        let found = coverage(&all);
        assert!(found.complete && !found.words.contains("add"));
    }
}
