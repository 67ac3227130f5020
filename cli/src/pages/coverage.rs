//! Which upward directions the placements cover.

use crate::report::{Picture, Placed, Sphere};

use super::session::Session;

/// A direction further than this from every placement is a gap, rad.
const GAP: f64 = 0.87;
/// Directions that are asked for at most.
const ASKED: usize = 6;
/// Directions tried.
const TRIED: usize = 2000;
/// A component above this is named, of a unit vector: edges have .71 of two, corners .58 of three.
const NAMED: f64 = 0.36;

/// What is covered and what is not.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Number of placements.
    pub placements: usize,
    /// Faces that point up in some placement: the face is the one nearest to the upward direction.
    pub faces: usize,
    /// Angle from the loneliest direction to its nearest placement, rad.
    pub gap: f64,
    /// Directions that are missing, the loneliest first.
    pub missing: Vec<[f64; 3]>,
}

impl Coverage {
    /// Of unit vectors.
    pub fn of(placements: &[[f64; 3]]) -> Self {
        let mut there = placements.to_vec();
        let (mut missing, mut gap) = (Vec::new(), None);
        while missing.len() < ASKED {
            let Some((loneliest, angle)) = loneliest(&there) else {
                break;
            };
            gap.get_or_insert(angle);
            if angle < GAP {
                break;
            }
            missing.push(loneliest);
            there.push(loneliest);
        }
        let mut faces: Vec<(usize, bool)> = placements.iter().map(face).collect();
        faces.sort_unstable();
        faces.dedup();
        Self {
            placements: placements.len(),
            faces: faces.len(),
            gap: gap.unwrap_or(std::f64::consts::PI),
            missing,
        }
    }

    /// `6 of 6 faces`.
    pub fn value(&self) -> String {
        format!("{} of 6 faces", self.faces)
    }

    /// How large the largest gap is, and where.
    pub fn note(&self) -> String {
        let place = self
            .missing
            .first()
            .map(|at| format!(", with {} up", words(at)));
        format!(
            "{} placements; the largest gap is {:.0}°{}",
            self.placements,
            self.gap.to_degrees(),
            place.unwrap_or_default()
        )
    }

    /// What to add, in words; `None` where nothing is missing.
    pub fn advice(&self) -> Option<String> {
        let mut all: Vec<String> = self.missing.iter().map(words).collect();
        all.dedup();
        (!all.is_empty()).then(|| {
            format!(
                "Add {} with these directions up: {}.",
                if all.len() == 1 {
                    "a placement"
                } else {
                    "placements"
                },
                all.join("; ")
            )
        })
    }
}

/// The picture of a session's placements.
pub fn picture(session: &Session<'_>, coverage: &Coverage) -> Picture {
    let placed = session.rests.iter().filter_map(|rest| {
        Some(Placed {
            at: rest.up?,
            key: rest.key.clone(),
            colour: 0,
        })
    });
    let missing = coverage.missing.iter();
    Picture::Sphere(
        "Directions that pointed up, seen from two sides".into(),
        Sphere {
            placed: placed.collect(),
            missing: missing.map(|at| (*at, words(at))).collect(),
        },
    )
}

/// `+x −y` for a direction between the two axes.
pub fn words(at: &[f64; 3]) -> String {
    let names = [["+x", "−x"], ["+y", "−y"], ["+z", "−z"]];
    let part = |k: usize| (at[k].abs() > NAMED).then(|| names[k][usize::from(at[k] < 0.0)]);
    (0..3).filter_map(part).collect::<Vec<_>>().join(" ")
}

fn face(at: &[f64; 3]) -> (usize, bool) {
    let largest = (0..3).max_by(|a, b| at[*a].abs().total_cmp(&at[*b].abs()));
    let axis = largest.unwrap_or(0);
    (axis, at[axis] > 0.0)
}

/// The direction furthest from all `placements`: of the middles of faces, edges and corners where one is nearly as
/// far, since a hand finds those.
fn loneliest(placements: &[[f64; 3]]) -> Option<([f64; 3], f64)> {
    let angle = |at: &[f64; 3]| {
        let near = placements
            .iter()
            .map(|p| p.iter().zip(at).map(|(a, b)| a * b).sum::<f64>());
        near.fold(-1.0, f64::max).clamp(-1.0, 1.0).acos()
    };
    let furthest = |all: Vec<[f64; 3]>| {
        let angles = all.into_iter().map(|at| (at, angle(&at)));
        angles.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let anywhere = furthest(spread())?;
    let handy = furthest(faces_edges_corners())?;
    Some(if handy.1 > 0.85 * anywhere.1 {
        (handy.0, anywhere.1)
    } else {
        anywhere
    })
}

fn faces_edges_corners() -> Vec<[f64; 3]> {
    let mut all = Vec::new();
    for code in (0..27).filter(|code| *code != 13) {
        let v = [code % 3, code / 3 % 3, code / 9].map(|c| f64::from(c) - 1.0);
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        all.push(v.map(|c| c / length));
    }
    all
}

/// Directions spread evenly (Fibonacci spiral; González, Measurement of areas on a sphere, 2010).
fn spread() -> Vec<[f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let direction = |k: usize| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / TRIED as f64;
        let (s, c) = (golden * k as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * c, r * s, z]
    };
    (0..TRIED).map(direction).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_faces_leave_the_corners_and_a_missing_face_is_asked_for() {
        let faces: Vec<_> = faces_edges_corners()
            .into_iter()
            .filter(|v| v.iter().any(|c| c.abs() > 0.9))
            .collect();
        let all = Coverage::of(&faces);
        // Corners of a cube are acos(1/√3) = 54.74° from its faces.
        assert!(
            (all.gap.to_degrees() - 54.74).abs() < 1.0,
            "{}",
            all.gap.to_degrees()
        );
        assert_eq!(all.faces, 6);
        let five: Vec<_> = faces.into_iter().filter(|v| v[2] < 0.9).collect();
        let five = Coverage::of(&five);
        assert_eq!((five.faces, words(&five.missing[0])), (5, "+z".into()));
        assert!(five.advice().unwrap().contains("+z"));
    }

    #[test]
    fn faces_edges_and_corners_have_no_gap() {
        let all = Coverage::of(&faces_edges_corners());
        assert!(all.missing.is_empty() && all.advice().is_none());
        assert_eq!(Coverage::of(&[]).faces, 0);
    }
}
