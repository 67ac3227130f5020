//! Words of calibrations and priors that cannot be used, or not on a recording.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::WrittenByNewer,
        "a newer version of the program wrote this file ({found}); this one reads {schema}",
        "use the newer one, or write the file again with this one",
        Vec::new,
    ),
    Entry::error(
        Kind::NotJson,
        "the file is no JSON: {reason}",
        "check that it is the right file and complete",
        Vec::new,
    ),
    Entry::error(
        Kind::SchemaMissing,
        "the file has no \"schema\" entry: not a calibration (\"{schema}\")",
        "name a calibration",
        Vec::new,
    ),
    Entry::error(
        Kind::EntryOther,
        "[{key}: ]\"{found}\" found, \"{expected}\" expected",
        "check that it is the right file",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixSingular,
        "[{key}: ]the matrix has no inverse: its axes lie in one plane, as no sensor's do",
        "check the numbers of the matrix",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixUnequal,
        "[{key}: ]the matrix amplifies one direction {times} times more than another: no sensor's axes are so",
        "check whether the file was edited",
        Vec::new,
    ),
    Entry::error(
        Kind::BiasBeyond,
        "[{key}: ]{found} found, which is {offset} {unit} at a reading of zero and no sensor's",
        "check whether the file was edited, or is of another sensor",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorFrame,
        "the prior holds in the triangular frame, and the symmetric frame was asked for",
        "leave out the symmetric frame",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorForeign,
        "the prior and the calibration have no parameter in common",
        "check that the prior was fitted to such devices",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorUnusable,
        "the file is no prior that can be used: mean or covariance is no number, or of another size than its {count:parameter}",
        "fit the prior again",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorDegenerate,
        "the prior's covariance and that of the recording make no covariance together",
        "fit the prior again, or calibrate without it",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorNotRecorded,
        "the recording has no {sensor}",
        "record it too",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorNotInCalibration,
        "the calibration has no {sensor}",
        "calibrate from a recording of it too",
        Vec::new,
    ),
    Entry::error(
        Kind::OfOtherUnits,
        "corrected by this calibration the specific force has a median of {median} where gravity is {gravity}: the calibration is for readings in another unit or of another device",
        "",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
    Entry::error(
        Kind::DevicesDiffer,
        "{first} and {second}: {parameter} is {one} in one and {two} in the other ({distance} standard errors): recordings of different devices or at very different temperatures[ (here {celsius})]",
        "",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
    Entry::error(
        Kind::GyroscopeOfOther,
        "{parameter} of the gyroscope differs by {change} ± {error} from that in the other recordings, as if it were of another device[, at another temperature than {celsius},] or its clock ran fast or slow",
        "",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
    Entry::error(
        Kind::ReadingsTwice,
        "this recording has the readings of {other}: {at} and those after it are static interval {interval} (t = {time}) of that one and those after it, with the same noise. Counted twice they make the standard errors too small",
        "leave one of the two out",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
    Entry::error(
        Kind::AxesOfOtherTurned,
        "this recording's axes are turned against those of {other}: by their biases and scale factors {axes}. One calibration of both would be wrong for either",
        "calibrate each recording alone",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
];
