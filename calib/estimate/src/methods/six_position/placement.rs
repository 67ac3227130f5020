//! Six placements, found by the direction of gravity.

use findings::{Finding, Findings, Kind};
use std::borrow::Borrow;

use nalgebra::{Matrix3x6, Vector3};
use recording::intervals::{Detector, StaticInterval, segment};
use recording::{Error, Recording};

findings::tuning! {
    /// A rest belongs to a face if its axis is within this of the vertical (cos 20°): hand placements
    /// are far nearer, edges and corners (45° and 55°) far beyond.
    WITHIN: f64 = 0.94;
}

/// Body axis that is vertical, and its sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// x down.
    XDown,
    /// x up.
    XUp,
    /// y down.
    YDown,
    /// y up.
    YUp,
    /// z down.
    ZDown,
    /// z up.
    ZUp,
}

impl Face {
    /// In the order of the published formulas.
    pub const ALL: [Self; 6] = [
        Self::XDown,
        Self::XUp,
        Self::YDown,
        Self::YUp,
        Self::ZDown,
        Self::ZUp,
    ];

    /// The direction of specific force (3): an accelerometer reads `+g` on the axis that is up.
    pub fn direction(self) -> Vector3<f64> {
        let k = self as usize;
        let mut direction = Vector3::zeros();
        direction[k / 2] = if k % 2 == 1 { 1.0 } else { -1.0 };
        direction
    }

    /// `x down`, …, `z up`.
    pub fn name(self) -> &'static str {
        ["x down", "x up", "y down", "y up", "z down", "z up"][self as usize]
    }

    /// The face that a mean reading shows; `None` between faces.
    pub fn of(mean: &Vector3<f64>) -> Option<Self> {
        let length = mean.norm();
        Self::ALL
            .into_iter()
            .find(|face| face.direction().dot(mean) > WITHIN.get() * length)
    }
}

/// A rest of the device on one of its faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Source of the placement: the recording's name, or the time in it.
    pub label: String,
    /// Mean reading of the accelerometer, m/s².
    pub accelerometer: Vector3<f64>,
    /// Mean reading of the gyroscope, rad/s.
    pub gyroscope: Option<Vector3<f64>>,
}

/// The six placements in the order of [`Face::ALL`].
#[derive(Clone, Debug, PartialEq)]
pub struct Six {
    placements: [Placement; 6],
    /// Placements that were passed over, and why.
    pub warnings: Findings,
}

impl Six {
    /// Sorts placements, in any order, by the face that is up. Rests between faces are passed over;
    /// of two on the same face the one with the norm nearest to `gravity` counts, and a warning
    /// names the other.
    ///
    /// # Errors
    /// A face without placement; the message also names the faces that have two.
    pub fn sort(placements: Vec<Placement>, gravity: f64) -> Result<Self, Error> {
        let mut by_face: [Vec<Placement>; 6] = Default::default();
        let mut warnings = Findings::new();
        for placement in placements {
            match Face::of(&placement.accelerometer) {
                Some(face) => by_face[face as usize].push(placement),
                None => warnings.push(Finding::of(Kind::OFF_FACE).detail("label", placement.label)),
            }
        }
        let missing: Vec<&str> = faces(&by_face, |n| n == 0).collect();
        let doubled: Vec<String> = faces(&by_face, |n| n > 1)
            .zip(by_face.iter().filter(|all| all.len() > 1))
            .map(|(face, all)| {
                let labels: Vec<&str> = all.iter().map(|p| p.label.as_str()).collect();
                format!("{face} more than once ({})", labels.join("; "))
            })
            .collect();
        if !missing.is_empty() {
            let found = Finding::of(Kind::FACE_MISSING).detail("missing", missing.join(", "));
            return Err(Error::not_enough(match doubled.is_empty() {
                true => found,
                false => found.detail("also", doubled.join(", ")),
            }));
        }
        warnings.extend(
            doubled
                .into_iter()
                .map(|face| Finding::of(Kind::FACE_TWICE).detail("face", face)),
        );
        let far = |p: &Placement| (p.accelerometer.norm() - gravity).abs();
        let mut chosen = by_face
            .into_iter()
            .filter_map(|all| all.into_iter().min_by(|a, b| far(a).total_cmp(&far(b))));
        let next = |_| chosen.next();
        let six: Vec<Placement> = (0..6).filter_map(next).collect();
        let placements = six
            .try_into()
            .map_err(|_| Error::not_enough(Finding::of(Kind::FACE_MISSING)))?;
        Ok(Self {
            placements,
            warnings,
        })
    }

    /// The placements in the order of [`Face::ALL`].
    pub fn placements(&self) -> &[Placement; 6] {
        &self.placements
    }

    /// Mean accelerometer readings (3 × 6), m/s².
    pub fn accelerometer(&self) -> Matrix3x6<f64> {
        Matrix3x6::from_columns(&self.placements.each_ref().map(|p| p.accelerometer))
    }

    /// Mean gyroscope readings (3 × 6), rad/s; `None` where one is missing.
    pub fn gyroscope(&self) -> Option<Matrix3x6<f64>> {
        let columns: Vec<_> = self.placements.iter().filter_map(|p| p.gyroscope).collect();
        (columns.len() == 6).then(|| Matrix3x6::from_columns(&columns))
    }
}

fn faces(
    by_face: &[Vec<Placement>; 6],
    is: fn(usize) -> bool,
) -> impl Iterator<Item = &'static str> {
    Face::ALL
        .into_iter()
        .zip(by_face.each_ref().map(Vec::len))
        .filter(move |(_, n)| is(*n))
        .map(|(f, _)| f.name())
}

/// The placements of one recording (all its rests) or of several (the longest rest of each).
///
/// # Errors
/// As the detector's, as [`Six::sort`]'s, and a recording without accelerometer or without rest.
pub fn placements<R: Borrow<Recording>>(
    recordings: &[R],
    detector: &Detector,
    gravity: f64,
) -> Result<Six, Error> {
    let mut all = Vec::new();
    for recording in recordings {
        let recording = recording.borrow();
        let rests = segment(recording, detector)?.statics;
        if recordings.len() == 1 {
            let label = |rest: &StaticInterval| format!("rest at {:.1} s", rest.span.from);
            all.extend(rests.iter().filter_map(|rest| placement(rest, label(rest))));
        } else {
            let longest = rests
                .iter()
                .max_by(|a, b| a.span.length().total_cmp(&b.span.length()));
            let found = longest.and_then(|rest| placement(rest, recording.name.clone()));
            all.push(found.ok_or_else(|| {
                Error::not_enough(
                    Finding::of(Kind::NO_REST)
                        .in_recording(&recording.name)
                        .of_sensor(sensor::Sensor::Accelerometer),
                )
            })?);
        }
    }
    Six::sort(all, gravity)
}

fn placement(rest: &StaticInterval, label: String) -> Option<Placement> {
    Some(Placement {
        label,
        accelerometer: rest.accelerometer?.mean,
        gyroscope: rest.gyroscope.map(|m| m.mean),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on(face: Face, label: &str) -> Placement {
        Placement {
            label: label.into(),
            accelerometer: face.direction() * 9.8,
            gyroscope: None,
        }
    }

    #[test]
    fn any_order_is_sorted_by_direction() {
        let shuffled = [5, 2, 0, 4, 1, 3].map(|k| on(Face::ALL[k], Face::ALL[k].name()));
        let six = Six::sort(shuffled.to_vec(), 9.8).unwrap();
        let labels = six.placements().each_ref().map(|p| p.label.as_str());
        assert_eq!(labels, Face::ALL.map(Face::name));
    }

    #[test]
    fn a_missing_face_and_a_doubled_one_are_named() {
        let faces = [
            Face::XDown,
            Face::XUp,
            Face::YDown,
            Face::YUp,
            Face::ZUp,
            Face::ZUp,
        ];
        let all: Vec<_> = ["a", "b", "c", "d", "e", "f"]
            .iter()
            .zip(faces)
            .map(|(l, f)| on(f, l))
            .collect();
        let message = Six::sort(all, 9.8).unwrap_err().to_string();
        assert!(message.contains("no rest with z down"), "{message}");
        assert!(message.contains("z up more than once (e; f)"), "{message}");
    }

    #[test]
    fn edges_are_passed_over_and_of_two_the_one_nearest_to_gravity_counts() {
        let mut all: Vec<_> = Face::ALL.iter().map(|&f| on(f, f.name())).collect();
        all.push(Placement {
            label: "edge".into(),
            accelerometer: Vector3::new(0.0, 6.9, 6.9),
            gyroscope: None,
        });
        all.push(Placement {
            label: "again".into(),
            accelerometer: Vector3::new(0.0, 0.0, 9.9),
            gyroscope: None,
        });
        let six = Six::sort(all, 9.8).unwrap();
        assert_eq!(six.placements()[5].label, "z up");
        assert_eq!(six.warnings.len(), 2);
        let off = &six.warnings[0];
        assert_eq!(
            (off.kind, off.word("label")),
            (Kind::OFF_FACE, Some("edge"))
        );
    }
}
