//! Words of errors: calibrations of other tools that are not read.

use crate::kind::Kind;
use crate::words::entry::{Entry, error};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ImportTooLarge => error(
            "the file has more than {limit:byte}, which no imu.yaml has",
            "name the imu.yaml of Kalibr",
        ),
        Kind::NoYaml => error(
            "the file is no YAML: {reason}",
            "correct the file, or name the imu.yaml of Kalibr",
        ),
        Kind::ImportEmpty => error(
            "the file is empty, where an imu.yaml of Kalibr was expected",
            "name the imu.yaml that Kalibr wrote",
        ),
        Kind::NoSensorsStated => error(
            "the file names no accelerometers and no gyroscopes: it states noise alone and corrects nothing",
            "run Kalibr with its IMU model scale-misalignment",
        ),
        Kind::NoEntries => error(
            "the file has no keys and values, as an imu.yaml of Kalibr has",
            "name the imu.yaml of Kalibr",
        ),
        Kind::ModelUnknown => error(
            "the file has the IMU model \"{found}\", and the program reads only {known}",
            "run Kalibr again with one of these models",
        ),
        Kind::NoRotation => error(
            "{entry} is no rotation: its rows must have length 1, stand at right angles and mirror nothing",
            "undo what was edited in the file, or run Kalibr again",
        ),
        Kind::MatrixExpected => error(
            "{entry}: three rows of three numbers expected",
            "correct the entry",
        ),
        Kind::VectorExpected => error("{entry}: three numbers expected", "correct the entry"),
        Kind::EntryMissing => error(
            "{entry}: missing, and an imu.yaml of Kalibr's model {model} has it",
            "write the file again by Kalibr",
        ),
        Kind::EntrySingular => error(
            "{entry}: the three axes of this matrix lie in one plane, as no sensor's do. So it has no inverse",
            "undo what was edited in the file, or write it again by the tool that made it",
        ),
        Kind::MatrixNumberExpected => error(
            "{of}, line {line}: a number expected: 9 of the misalignment matrix, 9 of the scale matrix, 3 of the bias",
            "correct the line",
        ),
        Kind::NumbersCount => error(
            "{of}: {found} numbers found, {expected} expected: misalignment matrix, scale matrix, bias",
            "name the file that imu_tk wrote",
        ),
        _ => return None,
    })
}
