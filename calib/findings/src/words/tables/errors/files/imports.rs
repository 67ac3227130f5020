//! Words of errors: calibrations of other tools that are not read.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ImportTooLarge,
        "a file of more than {limit:byte} is no imu.yaml",
        "",
        Vec::new,
    ),
    Entry::error(Kind::NoYaml, "no YAML: {reason}", "", Vec::new),
    Entry::error(Kind::ImportEmpty, "the file is empty", "", Vec::new),
    Entry::error(
        Kind::NoSensorsStated,
        "no accelerometers and no gyroscopes in it: it states noise alone and corrects nothing",
        "run Kalibr with its IMU model scale-misalignment",
        Vec::new,
    ),
    Entry::error(
        Kind::NoEntries,
        "keys and values expected, as in an imu.yaml of Kalibr",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ModelUnknown,
        "model: \"{found}\" found, one of {known} expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoRotation,
        "{entry}: no rotation, whose rows are of length 1 and at right angles",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixExpected,
        "{entry}: three rows of three numbers expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::VectorExpected,
        "{entry}: three numbers expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::EntryMissing,
        "{entry}: missing, and an imu.yaml of Kalibr's model {model} has it",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::EntrySingular,
        "{entry}: the matrix has no inverse",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::MatrixNumberExpected,
        "{of}, line {line}: a number expected: 9 of the misalignment matrix, 9 of the scale matrix, 3 of \
         the bias",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NumbersCount,
        "{of}: {found} numbers found, {expected} expected: misalignment matrix, scale matrix, bias",
        "",
        Vec::new,
    ),
];
