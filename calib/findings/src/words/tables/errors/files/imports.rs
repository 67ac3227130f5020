//! Words of errors: calibrations of other tools that are not read.

use crate::words::entry::error;

kinds! {
    /// A file is too large for a calibration.
    IMPORT_TOO_LARGE = "import_too_large" => error(
        "the file has more than {limit:byte}, which no imu.yaml has",
        "name the imu.yaml of Kalibr",
    ),
    /// A text is no YAML from a place on.
    NO_YAML = "no_yaml" => error(
        "the file is no YAML: {reason}",
        "correct the file, or name the imu.yaml of Kalibr",
    ),
    /// A calibration of another tool is empty.
    IMPORT_EMPTY = "import_empty" => error(
        "the file is empty, where an imu.yaml of Kalibr was expected",
        "name the imu.yaml that Kalibr wrote",
    ),
    /// A file of Kalibr states no sensors.
    NO_SENSORS_STATED = "no_sensors_stated" => error(
        "the file names no accelerometers and no gyroscopes: it states noise alone and corrects nothing",
        "run Kalibr with its IMU model scale-misalignment",
    ),
    /// A file of Kalibr has no keys and values.
    NO_ENTRIES = "no_entries" => error(
        "the file has no keys and values, as an imu.yaml of Kalibr has",
        "name the imu.yaml of Kalibr",
    ),
    /// A model of Kalibr is not known.
    MODEL_UNKNOWN = "model_unknown" => error(
        "the file has the IMU model \"{found}\", and the program reads only {known}",
        "run Kalibr again with one of these models",
    ),
    /// A matrix that should be a rotation is none.
    NO_ROTATION = "no_rotation" => error(
        "{entry} is no rotation: its rows must have length 1, stand at right angles and mirror nothing",
        "undo what was edited in the file, or run Kalibr again",
    ),
    /// An entry is no matrix of three rows.
    MATRIX_EXPECTED = "matrix_expected" => error(
        "{entry}: three rows of three numbers expected",
        "correct the entry",
    ),
    /// An entry is no vector.
    VECTOR_EXPECTED = "vector_expected" => error("{entry}: three numbers expected", "correct the entry"),
    /// A file of Kalibr lacks an entry of its model.
    ENTRY_MISSING = "entry_missing" => error(
        "{entry}: missing, and an imu.yaml of Kalibr's model {model} has it",
        "write the file again by Kalibr",
    ),
    /// A matrix of another tool has no inverse.
    ENTRY_SINGULAR = "entry_singular" => error(
        "{entry}: the three axes of this matrix lie in one plane, as no sensor's do. So it has no inverse",
        "undo what was edited in the file, or write it again by the tool that made it",
    ),
    /// A text of imu_tk has a word that is no number.
    MATRIX_NUMBER_EXPECTED = "matrix_number_expected" => error(
        "{of}, line {line}: a number expected: 9 of the misalignment matrix, 9 of the scale matrix, 3 of the bias",
        "correct the line",
    ),
    /// A text of imu_tk has too few numbers or too many.
    NUMBERS_COUNT = "numbers_count" => error(
        "{of}: {found} numbers found, {expected} expected: misalignment matrix, scale matrix, bias",
        "name the file that imu_tk wrote",
    ),
}
