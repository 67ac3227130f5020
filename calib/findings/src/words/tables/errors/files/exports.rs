//! Words of errors: calibrations that another tool cannot hold.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::SensorLacking => error(
            "the calibration has no {what}, and {target} needs one",
            "calibrate a recording of both sensors",
        ),
        Kind::ExportUnit => error(
            "the calibration is of readings of the {of} in {unit}, and {target} corrects readings in {si}",
            "calibrate a recording in {si}, as {target} logs it",
        ),
        Kind::ParameterOutside => error_with(
            "the parameter {name} would be {value}, and {target} takes only {least} to {most}",
            "check that the unit of the recording is right",
            vec![Remedy::set(OptionName::LoggedWith)],
        ),
        Kind::ExportLeftHanded => error_with(
            "{target} wants right-handed axes, and the {of}'s are left-handed (det T < 0): one axis has to be read with the other sign",
            "compare the axes of the {of} with those in the data sheet; where one points the other way, correct its sign in the recording and calibrate again",
            vec![Remedy::set(OptionName::Flip)],
        ),
        Kind::SignNotKept => error_by(
            "{target} has no negative scale factors, and the {of}'s scale factor of {axis} is {value}: this axis has to be read with the other sign",
            vec![Remedy::such_as(OptionName::Flip, "az")],
        ),
        Kind::CorrectedInForce => error_with(
            "{system} had corrected the readings of the {of} by its own parameters, and those of the \
         calibration would replace them",
            "calibrate a recording of {raw}",
            vec![Remedy::set(OptionName::LoggedWith)],
        ),
        Kind::CorrectedPartly => error(
            "{system} had corrected some recordings of the calibration ({corrected}) and not others ({others})",
            "calibrate the corrected recordings and the others apart",
        ),
        Kind::CorrectionTakenOff => error_by(
            "the log holds the parameters that {system} had applied to the readings of the {of}, and the program has taken them off already",
            vec![Remedy::Omit {
                option: OptionName::LoggedWith,
            }],
        ),
        Kind::ReadingsTurned => error(
            "{parameter} rotates the readings after they are corrected, so the calibration's axes are not those that the parameters correct",
            "calibrate a recording of the raw readings ({raw})",
        ),
        Kind::ParameterMissing => error(
            "the file of the vehicle's parameters (those it had while it logged) lacks {parameter}",
            "export all parameters of the vehicle",
        ),
        Kind::ParameterLine => error(
            "the file of the vehicle's parameters, line {line}: a parameter's name and a number expected, as in INS_ACCOFFS_X,0.12",
            "correct the line",
        ),
        Kind::InstanceBeyond => error_by(
            "the calibration is of sensor {instance}, and {system} has parameters for 0 to {most} only",
            vec![Remedy::such_as(OptionName::Instance, "0")],
        ),
        Kind::ScaleZero => error(
            "{target} divides by the scale factors, and one of them is zero: the readings of an axis do not change with the placement",
            "look for this axis in the recording, correct its column or its connection, and calibrate again",
        ),
        Kind::ScaleBeyondIntegers => error(
            "the scale factor of the {of} does not fit the integers of the {target}: {value} {unit} per count",
            "export the calibration in another format",
        ),
        Kind::ArchiveTooLarge => error(
            "the calibration is too large for an npz archive",
            "export the calibration in another format",
        ),
        Kind::PieceMissing => error(
            "this file is missing in the folder",
            "name a folder that holds it",
        ),
        _ => return None,
    })
}
