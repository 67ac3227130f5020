//! Words of calibrations and priors that cannot be used, or not on a recording.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::WrittenByNewer,
        "written as {found} by a newer version; this one reads {schema}",
        "use the newer one, or write the file again with this one",
        Vec::new,
    ),
    Entry::error(Kind::NotJson, "no JSON: {reason}", "", Vec::new),
    Entry::error(
        Kind::SchemaMissing,
        "no \"schema\" entry: not a calibration (\"{schema}\")",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::EntryOther,
        "[{key}: ]\"{found}\" found, \"{expected}\" expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixSingular,
        "[{key}: ]the matrix has no inverse",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixUnequal,
        "[{key}: ]one direction is amplified {times} times more than another: no sensor's axes are so",
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
        "the prior holds in the triangular frame",
        "leave out the symmetric frame",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorForeign,
        "the prior and the calibration have no parameter in common",
        "check that it was fitted to such devices",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorUnusable,
        "no prior: mean or covariance is no number, or of another size than its {count:parameter}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PriorDegenerate,
        "the prior's covariance and the session's are none together",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorNotRecorded,
        "the recording has no {sensor}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorNotInCalibration,
        "the calibration has no {sensor}",
        "",
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
        "has the readings of {other}: {at} and those after it are static interval {interval} (t = {time}) and those after it there, with the same noise. Counted twice they make the standard errors too small",
        "leave one of the two out",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
    Entry::error(
        Kind::AxesOfOtherTurned,
        "its axes are turned against those of {other}: by their biases and scale factors {axes}. One calibration of both would be wrong for either",
        "calibrate each alone",
        || vec![Remedy::set(OptionName::ForceDevice)],
    ),
];
