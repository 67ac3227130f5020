//! Words of errors: calibrations that another tool cannot hold.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::SensorLacking,
        "the calibration has no {what}, and {target} needs one",
        "calibrate a recording of both sensors",
        Vec::new,
    ),
    Entry::error(
        Kind::ExportUnit,
        "the calibration is of readings of the {of} in {unit}, and {target} corrects readings in {si}",
        "calibrate a recording in {si}, as {target} logs it",
        Vec::new,
    ),
    Entry::error(
        Kind::ParameterOutside,
        "the parameter {name} would be {value}, and {target} takes only {least} to {most}",
        "check that the unit of the recording is right",
        || vec![Remedy::set(OptionName::LoggedWith)],
    ),
    Entry::error(
        Kind::ExportLeftHanded,
        "{target} wants right-handed axes, and the {of}'s are left-handed (det T < 0): one axis has to be read with the other sign",
        "compare the axes of the {of} with those in the data sheet; where one points the other way, correct its sign in the recording and calibrate again",
        || vec![Remedy::set(OptionName::Flip)],
    ),
    Entry::error(
        Kind::SignNotKept,
        "{target} has no negative scale factors, and the {of}'s scale factor of {axis} is {value}: this axis has to be read with the other sign",
        "",
        || vec![Remedy::such_as(OptionName::Flip, "az")],
    ),
    Entry::error(
        Kind::CorrectedInForce,
        "{system} had corrected the readings of the {of} by its own parameters, and those of the \
         calibration would replace them",
        "calibrate a recording of {raw}",
        || vec![Remedy::set(OptionName::LoggedWith)],
    ),
    Entry::error(
        Kind::CorrectedPartly,
        "{system} had corrected some recordings of the calibration ({corrected}) and not others ({others})",
        "calibrate the corrected recordings and the others apart",
        Vec::new,
    ),
    Entry::error(
        Kind::CorrectionTakenOff,
        "the log holds the parameters that {system} had applied to the readings of the {of}, and the program has taken them off already",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::LoggedWith,
            }]
        },
    ),
    Entry::error(
        Kind::ReadingsTurned,
        "{parameter} rotates the readings after they are corrected, so the calibration's axes are not those that the parameters correct",
        "calibrate a recording of the raw readings ({raw})",
        Vec::new,
    ),
    Entry::error(
        Kind::ParameterMissing,
        "the file of the vehicle's parameters (those it had while it logged) lacks {parameter}",
        "export all parameters of the vehicle",
        Vec::new,
    ),
    Entry::error(
        Kind::ParameterLine,
        "the file of the vehicle's parameters, line {line}: a parameter's name and a number expected, as in INS_ACCOFFS_X,0.12",
        "correct the line",
        Vec::new,
    ),
    Entry::error(
        Kind::InstanceBeyond,
        "the calibration is of sensor {instance}, and {system} has parameters for 0 to {most} only",
        "",
        || vec![Remedy::such_as(OptionName::Instance, "0")],
    ),
    Entry::error(
        Kind::ScaleZero,
        "{target} divides by the scale factors, and one of them is zero: the readings of an axis do not change with the placement",
        "look for this axis in the recording, correct its column or its connection, and calibrate again",
        Vec::new,
    ),
    Entry::error(
        Kind::ScaleBeyondIntegers,
        "the scale factor of the {of} does not fit the integers of the {target}: {value} {unit} per count",
        "export the calibration in another format",
        Vec::new,
    ),
    Entry::error(
        Kind::ArchiveTooLarge,
        "the calibration is too large for an npz archive",
        "export the calibration in another format",
        Vec::new,
    ),
    Entry::error(
        Kind::PieceMissing,
        "this file is missing in the folder",
        "name a folder that holds it",
        Vec::new,
    ),
];
