//! Which orientations were recorded.

use nalgebra::Vector3;

/// Orientations closer than this count as one, cos 20°.
const SAME_ORIENTATION: f64 = 0.939_692_620_785_908_4;

/// A face counts as recorded by a placement within 45° of it.
const FACE_REACHED: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// `26 placements, 24 of which differ by more than 20°, none with z down`.
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
    if !missing.is_empty() {
        words.push_str(&format!("; add placements with {}", missing.join(", ")));
    }
    Coverage {
        words,
        complete: missing.is_empty(),
    }
}

/// Which orientations were recorded.
pub(super) struct Coverage {
    pub words: String,
    /// Every face was up and down at least once.
    pub complete: bool,
}
