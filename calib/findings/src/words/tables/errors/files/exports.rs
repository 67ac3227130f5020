//! Words of errors: calibrations that another tool cannot hold.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A target wants a sensor that is not calibrated.
    SENSOR_LACKING = "sensor_lacking" => error(
        "the calibration has no {what}, and {target} needs one",
        "calibrate a recording of both sensors",
    ),
    /// A target corrects readings in another unit.
    EXPORT_UNIT = "export_unit" => error(
        "the calibration is of readings of the {of} in {unit}, and {target} corrects readings in {si}",
        "calibrate a recording in {si}, as {target} logs it",
    ),
    /// A parameter lies beyond those that a target takes.
    PARAMETER_OUTSIDE = "parameter_outside" => error_with(
        "the parameter {name} would be {value}, and {target} takes only {least} to {most}",
        "check that the unit of the recording is right",
        vec![Remedy::set(OptionName::LoggedWith)],
    ),
    /// A target wants right-handed axes.
    EXPORT_LEFT_HANDED = "export_left_handed" => error_with(
        "{target} wants right-handed axes, and the {of}'s are left-handed (det T < 0): one axis has to be read with the other sign",
        "compare the axes of the {of} with those in the data sheet; where one points the other way, correct its sign in the recording and calibrate again",
        vec![Remedy::set(OptionName::Flip)],
    ),
    /// A target keeps no sign of an axis.
    SIGN_NOT_KEPT = "sign_not_kept" => error_by(
        "{target} has no negative scale factors, and the {of}'s scale factor of {axis} is {value}: this axis has to be read with the other sign",
        vec![Remedy::such_as(OptionName::Flip, "az")],
    ),
    /// Parameters in force would be replaced, and are not given.
    CORRECTED_IN_FORCE = "corrected_in_force" => error_with(
        "{system} had corrected the readings of the {of} by its own parameters, and those of the \
     calibration would replace them",
        "calibrate a recording of {raw}",
        vec![Remedy::set(OptionName::LoggedWith)],
    ),
    /// Some recordings of a calibration were corrected before, and others were not.
    CORRECTED_PARTLY = "corrected_partly" => error(
        "{system} had corrected some recordings of the calibration ({corrected}) and not others ({others})",
        "calibrate the corrected recordings and the others apart",
    ),
    /// Parameters in force were taken off already.
    CORRECTION_TAKEN_OFF = "correction_taken_off" => error_by(
        "the log holds the parameters that {system} had applied to the readings of the {of}, and the program has taken them off already",
        vec![Remedy::Omit {
            option: OptionName::LoggedWith,
        }],
    ),
    /// A parameter in force turns the readings.
    READINGS_TURNED = "readings_turned" => error(
        "{parameter} rotates the readings after they are corrected, so the calibration's axes are not those that the parameters correct",
        "calibrate a recording of the raw readings ({raw})",
    ),
    /// A parameter is not among those in force.
    PARAMETER_MISSING = "parameter_missing" => error(
        "the file of the vehicle's parameters (those it had while it logged) lacks {parameter}",
        "export all parameters of the vehicle",
    ),
    /// A line of the parameters in force is none.
    PARAMETER_LINE = "parameter_line" => error(
        "the file of the vehicle's parameters, line {line}: a parameter's name and a number expected, as in INS_ACCOFFS_X,0.12",
        "correct the line",
    ),
    /// A target has no parameters for the sensor.
    INSTANCE_BEYOND = "instance_beyond" => error_by(
        "the calibration is of sensor {instance}, and {system} has parameters for 0 to {most} only",
        vec![Remedy::such_as(OptionName::Instance, "0")],
    ),
    /// A scale factor is zero.
    SCALE_ZERO = "scale_zero" => error(
        "{target} divides by the scale factors, and one of them is zero: the readings of an axis do not change with the placement",
        "look for this axis in the recording, correct its column or its connection, and calibrate again",
    ),
    /// A scale factor does not fit the integers of a target.
    SCALE_BEYOND_INTEGERS = "scale_beyond_integers" => error(
        "the scale factor of the {of} does not fit the integers of the {target}: {value} {unit} per count",
        "export the calibration in another format",
    ),
    /// A calibration is too large for an archive.
    ARCHIVE_TOO_LARGE = "archive_too_large" => error(
        "the calibration is too large for an npz archive",
        "export the calibration in another format",
    ),
    /// A file of several is missing.
    PIECE_MISSING = "piece_missing" => error(
        "this file is missing in the folder",
        "name a folder that holds it",
    ),
}
