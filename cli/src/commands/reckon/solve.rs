//! One recording, reckoned with several calibrations.

use calib::Recording;
use calib::calibration::{Calibration, apply};
use calib::intervals::Span;
use calib::reckon::published::{Procedure, authors_proposed, authors_six_position};
use calib::reckon::{Ending, Mode, Motion, gap_in, reckon};
use nalgebra::Vector3;
use sensor::Base;
use serde::Serialize;

use crate::exit::Failure;

/// A tilt at the end beyond this is no error that has grown on the way, °.
const LOST: f64 = 10.0;

/// Motions that are listed one by one.
const LISTED: usize = 6;

/// The authors' calibration, as they used it.
pub(super) const AUTHORS_PROPOSED: &str = "authors-proposed";

/// Their six-position calibration.
const AUTHORS_SIX_POSITION: &str = "authors-six-position";

/// A way to correct readings, with a name.
#[derive(Debug)]
pub(super) struct Named {
    pub name: String,
    correction: Correction,
}

#[derive(Debug)]
enum Correction {
    None,
    /// Base model of the accelerometer alone.
    Base(Base<f64>),
    File(Box<Calibration>),
}

impl Named {
    pub(super) fn raw() -> Self {
        Self {
            name: "raw".into(),
            correction: Correction::None,
        }
    }

    pub(super) fn authors() -> [Self; 2] {
        [
            (AUTHORS_PROPOSED, authors_proposed()),
            (AUTHORS_SIX_POSITION, authors_six_position()),
        ]
        .map(|(name, base)| Self {
            name: name.into(),
            correction: Correction::Base(base),
        })
    }

    pub(super) fn file(name: &str, calibration: Calibration) -> Self {
        Self {
            name: name.into(),
            correction: Correction::File(Box::new(calibration)),
        }
    }

    /// The calibration of one that was read from a file.
    pub(super) fn of_file(&self) -> Option<&Calibration> {
        match &self.correction {
            Correction::File(calibration) => Some(calibration),
            Correction::None | Correction::Base(_) => None,
        }
    }

    fn apply(&self, recording: &Recording) -> Result<Recording, calib::Error> {
        let mut corrected = match &self.correction {
            Correction::File(calibration) => return apply(calibration, recording),
            Correction::None | Correction::Base(_) => recording.clone(),
        };
        if let (Correction::Base(base), Some(stream)) =
            (&self.correction, &mut corrected.accelerometer)
        {
            stream
                .values
                .iter_mut()
                .for_each(|value| *value = base.correct(value));
        }
        Ok(corrected)
    }
}

/// Known truth of the motion.
#[derive(Clone, Copy, Debug)]
pub(super) enum Known {
    Nothing,
    /// Displacement, m.
    Displacement(Vector3<f64>),
    /// Horizontal distance, m; the height did not change.
    Distance(f64),
}

/// One recording.
#[derive(Debug, Serialize)]
pub(super) struct Run {
    pub recording: String,
    /// When the motion was, s.
    pub motion: Option<Span>,
    pub results: Vec<Outcome>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// One recording with one calibration.
#[derive(Debug, Serialize)]
pub(super) struct Outcome {
    pub calibration: String,
    /// Position at the end of the motion, m.
    pub displacement: [f64; 3],
    /// In the horizontal plane, m; not known to the published procedure.
    pub horizontal: Option<f64>,
    /// Upwards, m.
    pub vertical: Option<f64>,
    /// Displacement less the true one, m.
    pub error: Option<[f64; 3]>,
    /// Horizontal distance less the true one, m.
    pub distance_error: Option<f64>,
    /// Norm of the specific force in the rest before, m/s².
    pub gravity: Option<f64>,
    /// Velocity at the end before any correction, m/s.
    pub end_velocity: Option<[f64; 3]>,
    /// Tilt taken off at the end, degrees.
    pub end_tilt: Option<f64>,
    /// Samples summed by the published procedure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<usize>,
    /// Position against time since the start, for the plots.
    #[serde(skip)]
    pub path: Vec<(f64, Vector3<f64>)>,
}

/// By the equations of motion.
pub(super) fn equations(
    recording: &Recording,
    calibrations: &[Named],
    span: Option<Span>,
    mode: Mode,
    ending: Ending,
    known: Known,
) -> Result<Run, Failure> {
    let found = Motion::all(recording);
    let (motion, all) = match span {
        // What is given needs no motion that is found.
        Some(span) => (Motion::given(recording, span)?, found.unwrap_or_default()),
        None => {
            let all = found?;
            (Motion::longest(&all, recording)?, all)
        }
    };
    let mut warnings = Vec::new();
    if span.is_none() && all.len() > 1 {
        warnings.push(several(&recording.name, &motion, &all));
    }
    if span.is_some() && ending != Ending::Free && motion.ends_in(&all) {
        warnings.push(format!(
            "{}: the device still moves at {:.1} s, where the motion is said to end: its velocity there is taken for zero, which it is \
             not; give an end at rest, or --ending free",
            recording.name, motion.span.to
        ));
    }
    if motion.after.is_none() && ending != Ending::Free {
        warnings.push(format!(
            "{}: no rest after the motion, so nothing is known of its end",
            recording.name
        ));
    }
    for (sensor, stream) in [
        ("accelerometer", &recording.accelerometer),
        ("gyroscope", &recording.gyroscope),
    ] {
        if let Some(gap) = stream
            .as_ref()
            .and_then(|stream| gap_in(stream, motion.span))
        {
            warnings.push(format!(
                "{}: the {sensor} has a gap of {:.2} s at t = {:.2} s, in the motion",
                recording.name,
                gap.length(),
                gap.from
            ));
        }
    }
    let mut results = Vec::new();
    for named in calibrations {
        let track = reckon(&named.apply(recording)?, &motion, mode, ending)?;
        let (horizontal, vertical) = track.distance();
        let tilt = track.end_tilt.map_or(0.0, f64::to_degrees);
        if named.of_file().is_some() && tilt > LOST {
            warnings.push(format!(
                "{}: with {} the attitude at the end is {tilt:.0}° off the vertical that the accelerometer reads there: the gyroscope has another unit, sign or order of axes than the calibration is for, or it was too fast for its range; compare them, for this motion is not to be trusted",
                recording.name, named.name
            ));
        }
        let start = track.t.first().copied().unwrap_or(0.0);
        results.push(Outcome {
            horizontal: Some(horizontal),
            vertical: Some(vertical),
            distance_error: match known {
                Known::Distance(distance) => Some(horizontal - distance),
                _ => None,
            },
            gravity: Some(track.gravity),
            end_velocity: Some(track.end_velocity.into()),
            end_tilt: track.end_tilt.map(f64::to_degrees),
            path: track
                .t
                .iter()
                .map(|t| t - start)
                .zip(track.position.iter().copied())
                .collect(),
            ..Outcome::new(&named.name, track.displacement(), known)
        });
    }
    Ok(Run {
        recording: recording.name.clone(),
        motion: Some(motion.span),
        results,
        warnings,
    })
}

/// The remark on a recording with several motions.
fn several(name: &str, taken: &Motion, all: &[Motion]) -> String {
    let others = all.iter().filter(|other| other.span != taken.span);
    let listed: Vec<String> = others
        .clone()
        .take(LISTED)
        .map(|other| format!("{:.1} to {:.1}", other.span.from, other.span.to))
        .collect();
    let more = match others.count().saturating_sub(LISTED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "{name}: of {} motions between rests only the longest is solved ({:.1} to {:.1} s); choose another by --motion T0,T1: {}{more} s",
        all.len(),
        taken.span.from,
        taken.span.to,
        listed.join(", "),
    )
}

/// Solves by the procedure of the published paper.
pub(super) fn published(
    recording: &Recording,
    calibrations: &[Named],
    procedure: &Procedure,
    picked_by: &str,
    known: Known,
) -> Result<Run, Failure> {
    let Some(picker) = calibrations.iter().find(|named| named.name == picked_by) else {
        let names: Vec<&str> = calibrations
            .iter()
            .map(|named| named.name.as_str())
            .collect();
        return Err(Failure::usage(format!(
            "--picked-by {picked_by}: no such calibration ({})",
            names.join(", ")
        )));
    };
    let missing = || calib::Error::not_enough(format!("{}: no accelerometer", recording.name));
    let picking = picker.apply(recording)?.accelerometer.ok_or_else(missing)?;
    let moving = procedure.moving(&picking);
    let results = calibrations
        .iter()
        .map(|named| {
            let corrected = named.apply(recording)?.accelerometer.ok_or_else(missing)?;
            let positions = procedure.positions(&corrected, &moving);
            let end = positions.last().copied().unwrap_or_else(Vector3::zeros);
            let time = (1..).map(|k| f64::from(k) / procedure.rate);
            Ok(Outcome {
                samples: Some(moving.len()),
                path: time.zip(positions).collect(),
                ..Outcome::new(&named.name, end, known)
            })
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    Ok(Run {
        recording: recording.name.clone(),
        motion: None,
        results,
        warnings: Vec::new(),
    })
}

impl Outcome {
    fn new(calibration: &str, displacement: Vector3<f64>, known: Known) -> Self {
        Self {
            calibration: calibration.into(),
            displacement: displacement.into(),
            horizontal: None,
            vertical: None,
            error: match known {
                Known::Displacement(truth) => Some((displacement - truth).into()),
                _ => None,
            },
            distance_error: None,
            gravity: None,
            end_velocity: None,
            end_tilt: None,
            samples: None,
            path: Vec::new(),
        }
    }

    /// Mean over the axes of the absolute error, m.
    pub(super) fn mean_error(&self) -> Option<f64> {
        self.error
            .map(|e| e.iter().map(|v| v.abs()).sum::<f64>() / 3.0)
    }
}
