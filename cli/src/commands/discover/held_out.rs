//! A recording to validate with is one that the fit has not seen.

use std::path::{Path, PathBuf};

use calib::Recording;
use calib::recording::Stream;

use crate::exit::Failure;
use crate::output::is_same_file;
use crate::show;

/// Refuses a validation recording that is one of the inputs by its path, through links too.
pub fn refuse_same_path(validation: Option<&Path>, inputs: &[PathBuf]) -> Result<(), Failure> {
    let Some(validation) = validation else {
        return Ok(());
    };
    let same = |input: &&PathBuf| is_same_file(input, validation);
    inputs.iter().find(same).map_or(Ok(()), |input| {
        Err(seen(&show::path(validation), &show::path(input)))
    })
}

/// Refuses a validation recording with the samples of one of `recordings`, whatever its stamps.
pub fn refuse_same_data(
    validation: Option<&Recording>,
    recordings: &[Recording],
) -> Result<(), Failure> {
    let Some(validation) = validation else {
        return Ok(());
    };
    let same = |recording: &&Recording| {
        are_same(&recording.accelerometer, &validation.accelerometer)
            || are_same(&recording.gyroscope, &validation.gyroscope)
    };
    recordings.iter().find(same).map_or(Ok(()), |recording| {
        Err(seen(&validation.name, &recording.name))
    })
}

/// Refuses two units with the samples of one.
pub fn refuse_twins(recordings: &[Recording]) -> Result<(), Failure> {
    for (k, one) in recordings.iter().enumerate() {
        let same = |other: &&Recording| {
            are_same(&one.accelerometer, &other.accelerometer)
                || are_same(&one.gyroscope, &other.gyroscope)
        };
        if let Some(other) = recordings[..k].iter().find(same) {
            return Err(Failure::usage(format!(
                "{} and {}: the same data, which would count twice; with --units each recording is another unit",
                other.name, one.name
            ))
            .advise("leave one of the two out"));
        }
    }
    Ok(())
}

fn are_same(one: &Option<Stream>, other: &Option<Stream>) -> bool {
    let pair = one.as_ref().zip(other.as_ref());
    pair.is_some_and(|(one, other)| one.values == other.values)
}

fn seen(validation: &str, input: &str) -> Failure {
    Failure::usage(format!(
        "--validation {validation}: the same data as {input}, which the fit has seen: what it shows there is no proof"
    ))
    .advise("name another recording of the device, or leave --validation out")
}
