//! Words of errors: calibrations of other tools that are not read.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ImportTooLarge,
        "the file has more than {limit:byte}, which no imu.yaml has",
        "name the imu.yaml of Kalibr",
        Vec::new,
    ),
    Entry::error(
        Kind::NoYaml,
        "the file is no YAML: {reason}",
        "correct the file, or name the imu.yaml of Kalibr",
        Vec::new,
    ),
    Entry::error(
        Kind::ImportEmpty,
        "the file is empty, where an imu.yaml of Kalibr was expected",
        "name the imu.yaml that Kalibr wrote",
        Vec::new,
    ),
    Entry::error(
        Kind::NoSensorsStated,
        "the file names no accelerometers and no gyroscopes: it states noise alone and corrects nothing",
        "run Kalibr with its IMU model scale-misalignment",
        Vec::new,
    ),
    Entry::error(
        Kind::NoEntries,
        "the file has no keys and values, as an imu.yaml of Kalibr has",
        "name the imu.yaml of Kalibr",
        Vec::new,
    ),
    Entry::error(
        Kind::ModelUnknown,
        "the file has the IMU model \"{found}\", and the program reads only {known}",
        "run Kalibr again with one of these models",
        Vec::new,
    ),
    Entry::error(
        Kind::NoRotation,
        "{entry} is no rotation: its rows must have length 1, stand at right angles and mirror nothing",
        "undo what was edited in the file, or run Kalibr again",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixExpected,
        "{entry}: three rows of three numbers expected",
        "correct the entry",
        Vec::new,
    ),
    Entry::error(
        Kind::VectorExpected,
        "{entry}: three numbers expected",
        "correct the entry",
        Vec::new,
    ),
    Entry::error(
        Kind::EntryMissing,
        "{entry}: missing, and an imu.yaml of Kalibr's model {model} has it",
        "write the file again by Kalibr",
        Vec::new,
    ),
    Entry::error(
        Kind::EntrySingular,
        "{entry}: the three axes of this matrix lie in one plane, as no sensor's do. So it has no inverse",
        "undo what was edited in the file, or write it again by the tool that made it",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixNumberExpected,
        "{of}, line {line}: a number expected: 9 of the misalignment matrix, 9 of the scale matrix, 3 of the bias",
        "correct the line",
        Vec::new,
    ),
    Entry::error(
        Kind::NumbersCount,
        "{of}: {found} numbers found, {expected} expected: misalignment matrix, scale matrix, bias",
        "name the file that imu_tk wrote",
        Vec::new,
    ),
];
