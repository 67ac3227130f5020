//! Words of readings that no working sensor gives.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// Axes repeat another one.
    AXIS_REPEATED = "axis_repeated" => error(
        "the {sensor}'s {repeated} in every row: {axes} not measured, but repeated",
        "correct the program that wrote the file",
    ),
    /// An axis never changes.
    AXIS_CONSTANT = "axis_constant" => error(
        "{sensor} {axis} is {value} in every row up to line {last}: {doubt}",
        "correct the column if it is the wrong one; if it is right, check the sensor and record again",
    ),
    /// An axis stops to change.
    AXIS_STUCK = "axis_stuck" => error(
        "{sensor} {axis} ({column}) is stuck at {value} from here to line {last} ({rows} rows) while the other axes go on",
        "cut these rows out, or record again",
    ),
    /// Readings are too small for any unit.
    READINGS_TINY = "readings_tiny" => error(
        "{sensor} {axis} never exceeds {peak}, too little for this sensor, as in a wrong unit",
        "give the unit in which the file was written; if that is right, check whether the sensor works",
    ),
    /// The unit changes part of the way.
    UNIT_CHANGES = "unit_changes" => error(
        "the length of the accelerometer's readings is {before} up to here and {after} from here on: the unit changes from {from} to {to}",
        "split the file here, or record again",
    ),
    /// The norm of gravity changes part of the way.
    NORM_CHANGES = "norm_changes" => error(
        "the length of the accelerometer's readings is {before} up to here and {after} from here on: another unit, another range or other columns",
        "split the file here, or record again",
    ),
    /// Readings overflow 16 bits.
    OVERFLOW = "overflow" => error_by(
        "{sensor} {axis} jumps from {from} to {to}: the true value grew beyond what 16 bits hold, and the number wrapped round",
        vec![Remedy::LargerRange],
    ),
    /// Readings of 16 bits lost their sign.
    SIGN_LOST = "sign_lost" => error(
        "{sensor} {axis} jumps from {from} to {to}: 16 bits without their sign, in which -1 is 65535",
        "print the readings as int16_t, or subtract 65536 from those above 32767",
    ),
    /// A sensor stops to read while the other goes on.
    SENSOR_STOPPED = "sensor_stopped" => error(
        "the {sensor} reads {reading} on all axes from t = {t0} to the end ({count} samples) while the other sensor goes on: disconnected?",
        "cut the recording at that time if at least ten placements lie before it; if not, check the sensor and record again",
    ),
    /// Rows of one stamp are as far apart as those of several devices.
    ROWS_OF_DEVICES = "rows_of_devices" => error_with(
        "{count} rows have the stamp of the row before. Their readings of the {sensor} differ by {apart} where rows of one device differ by {usual}: they may be of several devices",
        "export each device by itself if several wrote the rows; if one did, export finer time stamps",
        vec![Remedy::such_as(OptionName::Rate, "100")],
    ),
    /// Rows of several devices stand by turns.
    DEVICES_BY_TURNS = "devices_by_turns" => error(
        "the readings of the {sensor} repeat every {devices} rows and differ in between: rows of {devices} devices by turns, and no column tells them apart",
        "export each device by itself",
    ),
    /// A table holds rows of several devices.
    DEVICES_IN_TABLE = "devices_in_table" => error_by(
        "the table has rows of {count:device}, told apart by {column}: {listed}",
        vec![Remedy::such_as(OptionName::Instance, "1")],
    ),
    /// A device that is asked for has no rows.
    DEVICE_MISSING = "device_missing" => error(
        "the table has no device {wanted} among rows of {count} devices, told apart by {column}: {listed}",
        "choose one of these",
    ),
    /// A device is asked for, and no column tells devices apart.
    DEVICE_NOT_TOLD = "device_not_told" => error_by(
        "device {wanted} is asked for, and no column tells devices apart",
        vec![
            Remedy::Omit {
                option: OptionName::Instance,
            },
            Remedy::such_as(OptionName::Columns, "device=3"),
        ],
    ),
    /// Arrays differ in length.
    ARRAY_LENGTHS = "array_lengths" => error(
        "{array} has {rows:row}, t has {stamps}",
        "give arrays of one length",
    ),
    /// No array of a sensor has rows.
    ARRAYS_EMPTY = "arrays_empty" => error(
        "neither accel nor gyro has a row",
        "give at least one of them",
    ),
    /// An array holds a number that is not finite.
    ARRAY_NOT_FINITE = "array_not_finite" => error(
        "{array} is {value} here, which no sensor reads",
        "leave such rows out",
    ),
    /// There is one sample.
    ONE_SAMPLE = "one_sample" => error(
        "the recording has one sample only",
        "record for a minute or more",
    ),
}
