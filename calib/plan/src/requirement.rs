//! The one requirement of a hand-held calibration, and what is still missing of it.
//!
//! Every message that refuses or advises takes its numbers from here.

use std::fmt;

use findings::{Finding, Kind, Remedy, turns};
use nalgebra::Vector3;
use serde::Serialize;

use crate::accelerometer::{
    FORCE_NAMES, FORCE_PARAMETERS, ForceMatrix, force_covariance, force_information, reading_error,
};
use crate::direction::{Words, axes_up, faces, faces_edges_corners};
use crate::exchange::{Criterion, exchange};

findings::tuning! {
    /// Directions closer than this count as one, cos 20°.
    SAME: f64 = 0.939_692_620_785_908_4;
    /// A face counts as recorded by a placement within 50° of it: those of the edges beside it, not those of corners.
    FACE_REACHED: f64 = 0.642_787_609_686_539_3;
    /// Starts of an exchange that only adds placements.
    STARTS: usize = 40;
    /// Placements that are added at most.
    MOST_ADDED: usize = 30;
}

/// Requirement on the placements of a recording.
///
/// ```
/// use stillpoint_plan::REQUIREMENT;
///
/// assert!(REQUIREMENT.to_string().starts_with("record at least 10 placements"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Requirement {
    /// Placements at least: one more than the parameters of the accelerometer, to check them with.
    pub placements: usize,
    /// Placements that are advised.
    pub advised: usize,
    /// Turns at least: two numbers each, against the nine of the gyroscope.
    pub turns: usize,
    /// Duration of each static interval, s.
    pub rest: f64,
    /// Duration of the first static interval, s.
    pub first_rest: f64,
    /// Fastest turn, °/s.
    pub fastest: f64,
    /// Largest standard error of a parameter, in noises of one placement.
    pub largest_error: f64,
}

/// The requirement.
pub const REQUIREMENT: Requirement = Requirement {
    placements: FORCE_PARAMETERS + 1,
    advised: 12,
    turns: 5,
    rest: 5.0,
    first_rest: 60.0,
    fastest: 200.0,
    largest_error: 3.0,
};

impl fmt::Display for Requirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
    }
}

impl Requirement {
    /// The same as a finding: the reason of one that asks for more.
    pub fn finding(&self) -> Finding {
        Finding::of(Kind::REQUIREMENT)
            .count("least", self.placements)
            .count("advised", self.advised)
            .number("rest", self.rest, "s")
            .number("fastest", self.fastest.to_radians(), "rad/s")
    }
}

/// A direction that is to be recorded, in words.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wanted {
    /// Direction that points up, body frame, unit vector.
    pub up: [f64; 3],
    /// By the axes: `x up and z down`.
    pub axes: String,
    /// Instruction for a phone.
    pub words: String,
}

impl Wanted {
    /// In words.
    pub fn of(up: &Vector3<f64>) -> Self {
        Self {
            up: (*up).into(),
            axes: axes_up(up),
            words: Words::Phone.placement(up),
        }
    }

    /// `z up (a phone: flat on its back, screen up)`.
    pub fn named(&self) -> String {
        turns::placement(&self.axes, &self.words)
    }
}

/// Coverage of the directions by the placements, and the missing placements.
#[derive(Clone, Debug, Serialize)]
pub struct Coverage {
    /// Directions of the placements, body frame, unit.
    pub covered: Vec<[f64; 3]>,
    /// Number of placements that differ by more than 20°.
    pub distinct: usize,
    /// Faces that no placement comes within 50° of: places in [`faces`].
    pub missing_faces: Vec<usize>,
    /// Parameters that the placements leave open or know badly.
    pub unknown: Vec<&'static str>,
    /// Placements to add: the fewest that determine every parameter.
    pub wanted: Vec<Wanted>,
    /// Standard error of every parameter in noises of one placement, where the placements determine them.
    pub before: Option<[f64; FORCE_PARAMETERS]>,
    /// The same with what is wanted.
    pub after: Option<[f64; FORCE_PARAMETERS]>,
    /// Root mean square error of a corrected reading, in noises of one placement.
    pub reading_before: Option<f64>,
    /// The same with what is wanted.
    pub reading_after: Option<f64>,
}

impl Coverage {
    /// Returns true if nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.wanted.is_empty()
    }

    /// `9 placements, 7 of which differ by more than 20°`.
    pub fn found(&self) -> String {
        turns::placements(self.covered.len(), self.distinct)
    }

    /// `no placement has z up, z down`; empty where every face is there.
    pub fn missing(&self) -> String {
        let up = self.faces_up();
        up.map_or(String::new(), |up| turns::no_placement(&up))
    }

    /// `z up, z down`: the faces that no placement has; none where every face is there.
    fn faces_up(&self) -> Option<String> {
        let faces = faces();
        let up = self.missing_faces.iter().map(|k| axes_up(&faces[*k]));
        let up: Vec<String> = up.collect();
        (!up.is_empty()).then(|| up.join(", "))
    }

    /// A refusal of these placements: how many there are, what is missing, what to add and the requirement.
    pub fn refusal(&self, kind: Kind) -> Finding {
        let found = Finding::of(kind)
            .count("count", self.covered.len())
            .count("distinct", self.distinct)
            .because(REQUIREMENT.finding());
        let found = match self.faces_up() {
            Some(faces) => found.detail("missing", faces),
            None => found,
        };
        if self.wanted.is_empty() {
            return found;
        }
        let placements = self.wanted.iter().map(Wanted::named).collect();
        found.only_remedies([Remedy::AddPlacements { placements }])
    }

    /// `add 2 placements: 1) z up (a phone: flat on its back, screen up), 2) x down (…)`; empty where nothing is wanted.
    pub fn advice(&self) -> String {
        if self.wanted.is_empty() {
            return String::new();
        }
        let each: Vec<String> = self.wanted.iter().map(Wanted::named).collect();
        turns::add_placements(&each)
    }

    /// The same with so many more placements where nothing is missing but the noise.
    #[must_use]
    pub fn or_more(mut self, count: usize) -> Self {
        if self.wanted.is_empty() {
            let there: Vec<Vector3<f64>> = self.covered.iter().map(|u| Vector3::from(*u)).collect();
            let more = best_next(&there, count, &faces_edges_corners());
            self.wanted = more.iter().map(Wanted::of).collect();
        }
        self
    }
}

/// `x and y axes`: the axes of the turns that tell parameters of the gyroscope that are not known, by their names. An element of `T` in column `k` shows in turns about axis `k` while that axis lies level.
pub fn axes_wanted<'a>(unknown: impl IntoIterator<Item = &'a str>) -> String {
    let names = sensor::base_names(sensor::Sensor::Gyroscope);
    let mut about = [false; 3];
    for name in unknown {
        let place = names.iter().position(|own| own == name);
        if let Some((_, column)) = place.and_then(|k| sensor::PLACES.get(k)) {
            about[*column] = true;
        }
    }
    let all = about == [false; 3];
    let axes: Vec<&str> = ["x", "y", "z"]
        .into_iter()
        .zip(about)
        .filter_map(|(axis, own)| (own || all).then_some(axis))
        .collect();
    let plural = if axes.len() == 1 { "axis" } else { "axes" };
    format!("{} {plural}", axes.join(" and "))
}

/// Standard errors and error of a reading, in noises of one placement; `None` where a parameter is open.
fn known_to(information: &ForceMatrix) -> Option<([f64; FORCE_PARAMETERS], f64)> {
    let c = force_covariance(information)?;
    let errors = std::array::from_fn(|k| c[(k, k)].sqrt());
    Some((errors, reading_error(&c)))
}

/// Returns true if the placements meet the requirement.
pub fn is_determined(directions: &[Vector3<f64>]) -> bool {
    directions.len() >= REQUIREMENT.placements
        && known_to(&force_information(directions))
            .is_some_and(|(errors, _)| errors.iter().all(|e| *e <= REQUIREMENT.largest_error))
}

/// The parameters that placements leave open, or know worse than the requirement.
fn unknown(information: &ForceMatrix) -> Vec<&'static str> {
    let named = |is: &dyn Fn(usize) -> bool| {
        let all = FORCE_NAMES.iter().enumerate();
        all.filter(|(k, _)| is(*k)).map(|(_, n)| *n).collect()
    };
    if let Some((errors, _)) = known_to(information) {
        return named(&|k| errors[k] > REQUIREMENT.largest_error);
    }
    // A parameter is open where a combination that the placements do not see has a part of it.
    let eigen = information.symmetric_eigen();
    let none = 1e-9 * eigen.eigenvalues.max().max(1.0);
    named(&|k| {
        let parts = eigen.eigenvectors.row(k);
        let open = parts.iter().zip(&eigen.eigenvalues);
        open.filter(|(_, v)| **v < none)
            .any(|(part, _)| part.abs() > 1e-3)
    })
}

/// Returns the coverage of placements and the placements to add: the missing faces, then the fewest that meet
/// [`REQUIREMENT`].
pub fn coverage(directions: &[Vector3<f64>]) -> Coverage {
    let mut distinct: Vec<Vector3<f64>> = Vec::new();
    for u in directions {
        if distinct.iter().all(|d| d.dot(u) < SAME.get()) {
            distinct.push(*u);
        }
    }
    let missing_faces = missing_faces(directions);
    let information = force_information(directions);
    let added = fewest_with_faces(directions, &missing_faces);
    let all = [directions, &added].concat();
    let (before, after) = (known_to(&information), known_to(&force_information(&all)));
    Coverage {
        covered: directions.iter().map(|u| (*u).into()).collect(),
        distinct: distinct.len(),
        missing_faces,
        unknown: unknown(&information),
        wanted: added.iter().map(Wanted::of).collect(),
        before: before.map(|b| b.0),
        after: after.map(|a| a.0),
        reading_before: before.map(|b| b.1),
        reading_after: after.map(|a| a.1),
    }
}

/// Faces that no placement comes within 50° of.
fn missing_faces(directions: &[Vector3<f64>]) -> Vec<usize> {
    let faces = faces();
    let is_missing = |k: &usize| {
        directions
            .iter()
            .all(|u| faces[*k].dot(u) < FACE_REACHED.get())
    };
    (0..faces.len()).filter(is_missing).collect()
}

/// The missing faces, and the fewest placements beside them that meet the requirement.
fn fewest_with_faces(directions: &[Vector3<f64>], missing: &[usize]) -> Vec<Vector3<f64>> {
    let mut added: Vec<Vector3<f64>> = missing.iter().map(|k| faces()[*k]).collect();
    added.extend(fewest(&[directions, &added].concat()));
    added
}

/// The fewest placements (faces, edges, corners) that determine every parameter beside those that are there.
pub fn fewest(directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    if is_determined(directions) {
        return Vec::new();
    }
    let least = REQUIREMENT.placements.saturating_sub(directions.len());
    for count in least.max(1)..=MOST_ADDED.get() {
        let added = best_next(directions, count, &faces_edges_corners());
        if is_determined(&[directions, &added].concat()) {
            return added;
        }
    }
    Vec::new()
}

/// The `count` of `candidates` that lower the error of a corrected reading most beside the placements that are there.
pub fn best_next(
    directions: &[Vector3<f64>],
    count: usize,
    candidates: &[Vector3<f64>],
) -> Vec<Vector3<f64>> {
    let known = force_information(directions);
    let (chosen, _) = exchange(candidates, count, &known, Criterion::Reading, STARTS.get());
    chosen.iter().map(|k| candidates[*k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::edges;

    #[test]
    fn the_twelve_edges_meet_the_requirement_and_nine_placements_never_do() {
        assert!(coverage(&edges()).is_complete());
        assert!(!is_determined(&edges()[..9]));
    }

    #[test]
    fn six_faces_leave_the_misalignments_open_and_ask_for_four_more() {
        let found = coverage(&faces());
        assert_eq!(
            found.unknown,
            ["accel.alpha_yz", "accel.alpha_zy", "accel.alpha_zx"]
        );
        assert_eq!(found.wanted.len(), 4, "{}", found.advice());
        assert!(found.missing_faces.is_empty() && found.before.is_none());
        println!("{} {:?}", found.advice(), found.after);
    }

    #[test]
    fn a_face_that_is_missing_is_asked_for_in_the_same_words() {
        let all = faces_edges_corners();
        for (k, face) in faces().iter().enumerate() {
            // Nothing within 50° of it.
            let others = all.iter().filter(|u| u.dot(face) < 0.6).copied();
            let found = coverage(&others.collect::<Vec<_>>());
            assert_eq!(found.missing_faces, [k]);
            let words = axes_up(face);
            assert_eq!(found.missing(), format!("no placement has {words}"));
            assert_eq!(found.wanted[0].axes, words, "{}", found.advice());
        }
    }

    #[test]
    fn advice_that_is_followed_leaves_nothing_to_ask_for() {
        let all = faces_edges_corners();
        for (start, count) in (0..all.len()).flat_map(|k| [(k, 3), (k, 6), (k, 9), (k, 12)]) {
            let there: Vec<_> = (0..count)
                .map(|k| all[(start + 5 * k) % all.len()])
                .collect();
            let found = coverage(&there);
            let added = found.wanted.iter().map(|w| Vector3::from(w.up));
            let after = coverage(&[there, added.collect()].concat());
            assert!(after.is_complete(), "{}", after.advice());
        }
    }

    #[test]
    fn following_the_advice_is_at_most_one_placement_more_than_the_fewest_there_are() {
        let all = faces_edges_corners();
        for count in [6, 7, 8, 9, 10] {
            let there: Vec<_> = (0..count).map(|k| all[(k * k + 3 * k) % 14]).collect();
            let advised = fewest(&there);
            let least = exhaustive(&there, &all, advised.len());
            println!("{count}: advised {}, least {least}", advised.len());
            assert!(is_determined(&[there.as_slice(), &advised].concat()));
            assert!(
                advised.len() <= least + 1,
                "{count}: {} {least}",
                advised.len()
            );
        }
    }

    /// The fewest of `all` (repeats allowed) that determine everything, below `most`.
    fn exhaustive(there: &[Vector3<f64>], all: &[Vector3<f64>], most: usize) -> usize {
        fn any(
            there: &mut Vec<Vector3<f64>>,
            all: &[Vector3<f64>],
            from: usize,
            left: usize,
        ) -> bool {
            if left == 0 {
                return is_determined(there);
            }
            (from..all.len()).any(|k| {
                there.push(all[k]);
                let found = any(there, all, k, left - 1);
                there.pop();
                found
            })
        }
        let found = (0..most).find(|n| any(&mut there.to_vec(), all, 0, *n));
        found.unwrap_or(most)
    }
}
