//! Words of calibrations and priors that cannot be used, or not on a recording.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_with};

kinds! {
    /// A file was written by a newer version.
    WRITTEN_BY_NEWER = "written_by_newer" => error(
        "a newer version of the program wrote this file ({found}); this one reads {schema}",
        "use the newer one, or write the file again with this one",
    ),
    /// A file is not JSON.
    NOT_JSON = "not_json" => error(
        "the file is no JSON: {reason}",
        "check that it is the right file and complete",
    ),
    /// A file does not say its schema.
    SCHEMA_MISSING = "schema_missing" => error(
        "the file has no \"schema\" entry: not a calibration (\"{schema}\")",
        "name a calibration",
    ),
    /// An entry says another thing than expected.
    ENTRY_OTHER = "entry_other" => error(
        "[{key}: ]\"{found}\" found, \"{expected}\" expected",
        "check that it is the right file",
    ),
    /// The matrix of a sensor has no inverse.
    MATRIX_SINGULAR = "matrix_singular" => error(
        "[{key}: ]the matrix has no inverse: its axes lie in one plane, as no sensor's do",
        "check the numbers of the matrix",
    ),
    /// A matrix amplifies its axes as that of no sensor.
    MATRIX_UNEQUAL = "matrix_unequal" => error(
        "[{key}: ]the matrix enlarges one direction {times} times as much as another, as no sensor does",
        "undo what was edited in the file, or calibrate again",
    ),
    /// A bias is that of no sensor.
    BIAS_BEYOND = "bias_beyond" => error(
        "[{key}: ]the bias (the constant error of the readings) is {found}, which makes {offset} {unit}: more than any sensor has",
        "undo what was edited in the file, or calibrate again",
    ),
    /// A prior is used in a frame that it does not hold in.
    PRIOR_FRAME = "prior_frame" => error(
        "the prior (typical values of a type of device) is for the usual choice of axes. The calibration has the symmetric one (symmetric frame)",
        "calibrate again without the symmetric frame; if you need this frame, calibrate without the prior",
    ),
    /// A prior has no parameter of the calibration.
    PRIOR_FOREIGN = "prior_foreign" => error(
        "the prior (typical values of a type of device) and the calibration have no parameter in common. They may be of other sensors",
        "use the prior of this type of device if you named another; if you have none, calibrate without a prior",
    ),
    /// A prior has sizes or numbers that make no distribution.
    PRIOR_UNUSABLE = "prior_unusable" => error(
        "the prior (typical values of a type of device) cannot be used: it should hold a mean and a covariance for each of {count:parameter}, and does not",
        "make the prior again from the batch of these devices; if you do not have the batch, calibrate without the prior",
    ),
    /// The covariances of prior and session are none together.
    PRIOR_DEGENERATE = "prior_degenerate" => error(
        "the prior (typical values of a type of device) does not go with the recording: the fit of both together has no solution. The prior is damaged, or was made of too few devices",
        "calibrate without the prior now; for later devices, make the prior again from more devices",
    ),
    /// A recording has no readings of a sensor.
    SENSOR_NOT_RECORDED = "sensor_not_recorded" => error("the recording has no {sensor}", "record it too"),
    /// A calibration has nothing of a sensor.
    SENSOR_NOT_IN_CALIBRATION = "sensor_not_in_calibration" => error(
        "the calibration has no {sensor}",
        "calibrate from a recording of it too",
    ),
    /// A calibration is for readings in another unit.
    OF_OTHER_UNITS = "of_other_units" => error_with(
        "corrected by this calibration, the accelerometer's readings have a median length of {median}, where gravity is {gravity}. The calibration is for another unit or another device",
        "use this calibration for no recording of another device",
        vec![
            Remedy::OwnCalibration,
            Remedy::set(OptionName::AccelUnit),
            Remedy::set(OptionName::ForceDevice),
        ],
    ),
    /// A calibration is for readings with other axes flipped.
    FLIPPED_OTHERWISE = "flipped_otherwise" => error_with(
        "the calibration is for readings of the {sensor} with {own} flipped (read with the other sign), and here {other} is",
        "read this recording as that of the calibration was read",
        vec![
            Remedy::set_to(OptionName::Flip, "gx"),
            Remedy::set(OptionName::ForceDevice),
        ],
    ),
    /// Accelerometers of two recordings differ as those of two devices.
    DEVICES_DIFFER = "devices_differ" => error_with(
        "{parameter} is {one} in {first} and {two} in {second}, {distance} standard errors apart. The recordings are of different devices, or of one device at different temperatures[ ({celsius})][. All scale factors differ by {gravity}, as where gravity is another: at another place]",
        "calibrate each recording alone if the devices or the places differ; if it is one device, record again at one temperature",
        vec![Remedy::set(OptionName::ForceDevice)],
    ),
    /// The gyroscope of a recording differs as that of another device.
    GYROSCOPE_OF_OTHER = "gyroscope_of_other" => error_with(
        "{parameter} of the gyroscope differs by {change} ± {error} from the other recordings. This recording is of another device[, or at another temperature ({celsius})], or its clock ran fast or slow",
        "calibrate this recording alone if the device is another; if it is the same, record again at the temperature of the others and with the time stamps of the sensor",
        vec![Remedy::set(OptionName::ForceDevice)],
    ),
    /// The readings of a recording are in another one too.
    READINGS_TWICE = "readings_twice" => error(
        "this recording repeats readings of {other}: from {at} on they equal those from[ static interval {interval},] t = {time} on. Counted twice they make the standard errors too small",
        "leave one of the two out: a recording, or the rows that come again",
    ),
    /// A recording is of the same device in turned axes.
    AXES_OF_OTHER_TURNED = "axes_of_other_turned" => error_with(
        "the axes of this recording are turned against those of {other}: by their biases and scale factors, {axes}. One calibration of both would be wrong for either",
        "compare the order and the signs of the columns in both recordings, and correct them if they are wrong; if they are right, calibrate each recording alone",
        vec![Remedy::set(OptionName::ForceDevice)],
    ),
}
