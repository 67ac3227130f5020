//! Words of units and gravity that cannot be right.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::UnitUnknown => error(
            "this unit is unknown; known: {known}",
            "choose one of these",
        ),
        Kind::GravityOfNoUnit => error_by(
            "at rest the accelerometer's readings have the length {radius}, which is gravity in no unit that the program knows. They may be raw whole numbers (counts)",
            vec![Remedy::examples([
                (OptionName::AccelUnit, "counts"),
                (OptionName::AccelUnit, "m/s^2"),
            ])],
        ),
        Kind::UnitStrange => error_by(
            "the file states {unit} for the {sensor}, which is no unit that the program knows. The readings do not show their unit either",
            vec![Remedy::examples([
                (OptionName::AccelUnit, "m/s^2"),
                (OptionName::GyroUnit, "deg/s"),
                (OptionName::Columns, "ax=NAME*0.001"),
            ])],
        ),
        Kind::GravityRemoved => error(
            "the accelerometer's readings have a median length of {norm} {unit}: gravity has been removed, and calibration needs it",
            "record the accelerometer with gravity (\"total\", \"uncalibrated\" or \"with g\")",
        ),
        Kind::AxesOfTheRoom => error(
            "by the gyroscope the device was turned over {turns} times, by up to {angle}, and at rest the accelerometer always reads the same: its readings are given in axes of the room and not of the device",
            "record the accelerometer in the axes of the device (\"raw\" or \"uncalibrated\"; not \"world\", \"earth\" or \"global\")",
        ),
        Kind::AnglesForRates => error_with(
            "at rest the gyroscope reads another value in each placement, over a range of {range}, as angles (roll, pitch, yaw) do: these are no rates of rotation",
            "record the gyroscope (\"angular velocity\", \"rotation rate\" or \"gyro\"), not the orientation",
            vec![Remedy::set(OptionName::Columns)],
        ),
        Kind::Normalised => error(
            "the accelerometer's readings have the same length, {length}, in every row, while the device turns too: they were normalised to a direction, and no force is left in them",
            "record the accelerometer before it is normalised (\"raw\" or \"uncalibrated\")",
        ),
        Kind::GravityInOtherUnit => error_by(
            "at rest the accelerometer reads {radius} in all orientations. That is gravity in {right}, and {by} says {unit}",
            vec![Remedy::set_to(OptionName::AccelUnit, "g")],
        ),
        Kind::GravityOff => error_by(
            "at rest the accelerometer reads {radius} in all orientations, which is {ratio} times gravity in {unit}, as {by} says. They may be raw whole numbers (counts)",
            vec![Remedy::set_to(OptionName::AccelUnit, "counts")],
        ),
        Kind::TurnsImpossible => error_by(
            "the file states {unit} for the gyroscope. In that unit the device would often turn faster than {fastest}, as no hand turns it",
            vec![Remedy::examples([
                (OptionName::GyroUnit, "deg/s"),
                (OptionName::GyroUnit, "counts"),
            ])],
        ),
        Kind::TurnsInOtherUnit => error_by(
            "{by} {unit} for the gyroscope. But its turns agree with those that the accelerometer saw only in {told}",
            vec![Remedy::such_as(OptionName::GyroUnit, "deg/s")],
        ),
        Kind::TurnsOff => error_with(
            "{by} {unit} for the gyroscope. But the accelerometer saw turns about {factor} times as far, so the unit of the gyroscope or of the time stamps is wrong",
            "look both units up in the documentation of what wrote the file, and give the right one",
            vec![Remedy::examples([
                (OptionName::TimeUnit, "us"),
                (OptionName::GyroUnit, "counts"),
                (OptionName::Columns, "t=NAME"),
            ])],
        ),
        Kind::UnitUntold => error_by(
            "neither the file nor the readings tell the unit of the gyroscope[, and the recording of the calibration was in {other}][. In {faster}, as the recording of the calibration, the device would turn faster than gyroscopes can read][. In {still}, unlike the recording of the calibration, it would have the bias of the calibration]",
            vec![Remedy::such_as(OptionName::GyroUnit, "deg/s")],
        ),
        Kind::RestlessRest => error_by(
            "the device never turns, so that no turn shows the gyroscope's unit. In {unit} its noise would be {noise} and its bias (mean at rest) {bias}, as no gyroscope has",
            vec![Remedy::such_as(OptionName::GyroUnit, "deg/s")],
        ),
        Kind::SensorsSwapped => error(
            "the columns of the gyroscope turn with gravity from rest to rest, and those of the accelerometer do not: their names are swapped",
            "[give {files} the other way round]",
        ),
        Kind::ForceAsRate => error_with(
            "the columns of the gyroscope keep the length {length} whatever the attitude, as gravity does: they hold no rates",
            "name them as the accelerometer's; if they do hold a gyroscope, give its unit",
            vec![Remedy::examples([
                (OptionName::Columns, "ax=NAME,ay=NAME,az=NAME"),
                (OptionName::GyroUnit, "rad/s"),
            ])],
        ),
        Kind::RateUnitChanges => error(
            "the gyroscope's turns are those that the accelerometer saw in {from} up to t = {until}, and in {to} from t = {since} on",
            "convert the readings to one unit, or split the file there",
        ),
        _ => return None,
    })
}
