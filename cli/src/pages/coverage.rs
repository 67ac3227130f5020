//! Coverage of the upward directions by the placements.

use findings::turns;
use nalgebra::Vector3;

use crate::report::{Figure, Picture, Placed, Sphere};

use super::session::Session;

/// Faces of a device.
const FACES: usize = 6;
/// Parameters of an accelerometer.
const PARAMETERS: usize = plan::FORCE_PARAMETERS;

/// Covered directions and placements to add.
#[derive(Clone, Debug)]
pub struct Coverage(plan::Coverage);

impl Coverage {
    /// Computes the coverage from unit vectors.
    pub fn of(placements: &[[f64; 3]]) -> Self {
        let ups: Vec<Vector3<f64>> = placements.iter().map(|up| Vector3::from(*up)).collect();
        Self(plan::coverage(&ups))
    }

    /// `6 of 6 faces`.
    pub fn value(&self) -> String {
        format!("{} of {FACES} faces", FACES - self.0.missing_faces.len())
    }

    /// Returns the number of placements, of different ones, and of parameters not known well, in words.
    fn note(&self) -> String {
        let faces = Some(self.0.missing()).filter(|words| !words.is_empty());
        let open = Some(self.0.unknown.len()).filter(|count| *count > 0);
        let open = open.map(|count| format!("{count} of {PARAMETERS} parameters not known well"));
        let parts = std::iter::once(self.0.found()).chain(faces).chain(open);
        parts.collect::<Vec<_>>().join("; ")
    }

    /// The figure at the head of a page.
    pub fn figure(&self) -> Figure {
        Figure::new("Directions covered", self.value(), self.note())
    }

    /// Returns the placements to add, in words; `None` if nothing is missing.
    pub fn advice(&self) -> Option<String> {
        let words = self.0.advice();
        let words = words.strip_prefix("add").map(|rest| format!("Add{rest}."));
        words.filter(|_| !self.0.is_complete())
    }

    /// The same as a recording of its own; `None` if nothing is missing.
    pub fn second_recording(&self) -> Option<String> {
        let wanted = self.0.wanted.iter().map(plan::Wanted::named);
        let wanted: Vec<String> = wanted.collect();
        let placements = match wanted.as_slice() {
            [] => return None,
            [one] => format!("1 more placement: {one}"),
            all => format!("{} more placements: {}", all.len(), turns::numbered(all)),
        };
        let each = if wanted.len() > 1 { " in each" } else { "" };
        Some(format!(
            "Make a second recording with {placements}. Leave the device still for {:.0} s{each}, and calibrate both \
             recordings together",
            plan::REQUIREMENT.rest
        ))
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
    let missing = coverage.0.wanted.iter();
    Picture::Sphere(
        "Directions that pointed up, seen from two sides".into(),
        Sphere {
            placed: placed.collect(),
            missing: missing.map(|w| (w.up, w.axes.clone())).collect(),
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_faces_leave_misalignments_open_and_a_missing_face_is_asked_for() {
        let faces = plan::faces().map(<[f64; 3]>::from);
        let all = Coverage::of(&faces);
        assert_eq!(all.value(), "6 of 6 faces");
        assert!(all.note().contains("3 of 9 parameters"), "{}", all.note());
        let four = Coverage::of(&faces[..4]);
        assert_eq!(four.value(), "4 of 6 faces");
        assert!(four.note().contains("no placement has z up, z down"));
        let advice = four.advice().unwrap();
        assert!(advice.starts_with("Add 6 placements: 1) z up"), "{advice}");
        assert!(advice.contains("2) z down"), "{advice}");
    }

    #[test]
    fn faces_edges_and_corners_leave_nothing_to_add() {
        let all: Vec<[f64; 3]> = plan::faces_edges_corners()
            .iter()
            .map(|u| (*u).into())
            .collect();
        let all = Coverage::of(&all);
        assert!(all.advice().is_none(), "{all:?}");
        assert_eq!(Coverage::of(&[]).value(), "0 of 6 faces");
    }
}
