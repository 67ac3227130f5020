//! What a calibration is refused for, fails its gate for, or warns of.

mod coverage;
mod determined;
mod mounting;
mod rests;

pub(super) use determined::{
    ForceEvidence, RateEvidence, accelerometer_is_determined, gyroscope_is_determined,
};
pub(super) use mounting::{gyroscope_gates, turned_axes};
pub(super) use rests::{disagreeing_rests, long_turns, restless};

use nalgebra::Vector3;
use sensor::Kinematics;

use crate::error::Error;
use crate::methods::Choice;
use crate::recording::Recording;
use crate::residuals::StaticMean;

/// The recordings without repeats of the same data.
pub(super) fn without_repeats<'a>(
    recordings: &'a [Recording],
    warnings: &mut Vec<String>,
) -> Vec<&'a Recording> {
    let mut kept: Vec<&Recording> = Vec::new();
    for recording in recordings {
        let twin = kept.iter().find(|k| {
            k.accelerometer == recording.accelerometer && k.gyroscope == recording.gyroscope
        });
        match twin {
            Some(twin) => warnings.push(format!(
                "{}: the same data as {}; counted once",
                recording.name, twin.name
            )),
            None => kept.push(recording),
        }
        warnings.extend(recording.warnings.iter().cloned());
    }
    kept
}

/// What a user should know of how a recording was cut.
pub(super) fn of_the_detector(recording: &Recording, choice: &Choice) -> Vec<String> {
    let named = |remark| format!("{}: {remark}", recording.name);
    choice.remarks().into_iter().map(named).collect()
}

/// A mean of which nothing else is known.
pub(super) fn bare_mean(raw: Vector3<f64>) -> StaticMean {
    StaticMean {
        raw,
        rest: Kinematics::at_rest(Vector3::zeros()),
        white: 0.0,
    }
}

/// Refuses recordings without rests or without turns.
pub(super) fn enough_rests(
    recordings: &[&Recording],
    choices: &[Choice],
    means: &[Vec<StaticMean>],
) -> Result<(), Error> {
    let names: Vec<&str> = recordings.iter().map(|r| r.name.as_str()).collect();
    let rejected = choices.iter().flat_map(|c| &c.segmentation.rejected);
    let found = means.iter().map(Vec::len).sum::<usize>();
    if let Some(first) = rejected.clone().next().filter(|_| found < 2) {
        return Err(Error::NotEnough(format!(
            "{}: {found} static intervals; {} quiet stretches are none, the first: {first}",
            names.join(", "),
            rejected.count()
        )));
    }
    match found {
        0 => Err(Error::NotEnough(format!(
            "{}: no static interval: the device is never still for long enough; lay it down for 5 s \
             between the turns, or lower --min-static or raise --multiplier",
            names.join(", ")
        ))),
        1 => {
            let length: f64 = choices
                .iter()
                .flat_map(|c| &c.segmentation.statics)
                .map(|rest| rest.span.length())
                .sum();
            Err(Error::NotEnough(format!(
                "{}: all static: one rest of {length:.1} s and no turn; turn the device to at least \
                 ten orientations (each face up and down, then edges and corners) and hold it still \
                 for 5 s in each",
                names.join(", ")
            )))
        }
        _ => Ok(()),
    }
}
