//! Words of readings that no working sensor gives.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::AxisRepeated => error(
            "the {sensor}'s {repeated} in every row: {axes} not measured, but repeated",
            "correct the program that wrote the file",
        ),
        Kind::AxisConstant => error(
            "{sensor} {axis} is {value} in every row up to line {last}: {doubt}",
            "correct the column if it is the wrong one; if it is right, check the sensor and record again",
        ),
        Kind::AxisStuck => error(
            "{sensor} {axis} ({column}) is stuck at {value} from here to line {last} ({rows} rows) while the other axes go on",
            "cut these rows out, or record again",
        ),
        Kind::ReadingsTiny => error(
            "{sensor} {axis} never exceeds {peak}, too little for this sensor, as in a wrong unit",
            "give the unit in which the file was written; if that is right, check whether the sensor works",
        ),
        Kind::UnitChanges => error(
            "the length of the accelerometer's readings is {before} up to here and {after} from here on: the unit changes from {from} to {to}",
            "split the file here, or record again",
        ),
        Kind::NormChanges => error(
            "the length of the accelerometer's readings is {before} up to here and {after} from here on: another unit, another range or other columns",
            "split the file here, or record again",
        ),
        Kind::Overflow => error_by(
            "{sensor} {axis} jumps from {from} to {to}: the true value grew beyond what 16 bits hold, and the number wrapped round",
            vec![Remedy::LargerRange],
        ),
        Kind::SignLost => error(
            "{sensor} {axis} jumps from {from} to {to}: 16 bits without their sign, in which -1 is 65535",
            "print the readings as int16_t, or subtract 65536 from those above 32767",
        ),
        Kind::SensorStopped => error(
            "the {sensor} reads {reading} on all axes from t = {t0} to the end ({count} samples) while the other sensor goes on: disconnected?",
            "cut the recording at that time if at least ten placements lie before it; if not, check the sensor and record again",
        ),
        Kind::RowsOfDevices => error_with(
            "{count} rows have the stamp of the row before. Their readings of the {sensor} differ by {apart} where rows of one device differ by {usual}: they may be of several devices",
            "export each device by itself if several wrote the rows; if one did, export finer time stamps",
            vec![Remedy::such_as(OptionName::Rate, "100")],
        ),
        Kind::DevicesByTurns => error(
            "the readings of the {sensor} repeat every {devices} rows and differ in between: rows of {devices} devices by turns, and no column tells them apart",
            "export each device by itself",
        ),
        Kind::DevicesInTable => error_by(
            "the table has rows of {count:device}, told apart by {column}: {listed}",
            vec![Remedy::such_as(OptionName::Instance, "1")],
        ),
        Kind::DeviceMissing => error(
            "the table has no device {wanted} among rows of {count} devices, told apart by {column}: {listed}",
            "choose one of these",
        ),
        Kind::DeviceNotTold => error_by(
            "device {wanted} is asked for, and no column tells devices apart",
            vec![
                Remedy::Omit {
                    option: OptionName::Instance,
                },
                Remedy::such_as(OptionName::Columns, "device=3"),
            ],
        ),
        Kind::ArrayLengths => error(
            "{array} has {rows:row}, t has {stamps}",
            "give arrays of one length",
        ),
        Kind::ArraysEmpty => error(
            "neither accel nor gyro has a row",
            "give at least one of them",
        ),
        Kind::ArrayNotFinite => error(
            "{array} is {value} here, which no sensor reads",
            "leave such rows out",
        ),
        Kind::OneSample => error(
            "the recording has one sample only",
            "record for a minute or more",
        ),
        _ => return None,
    })
}
