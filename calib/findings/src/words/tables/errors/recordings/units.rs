//! Words of units and gravity that cannot be right.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A unit is not known.
    UNIT_UNKNOWN = "unit_unknown" => error(
        "this unit is unknown; known: {known}",
        "choose one of these",
    ),
    /// Gravity has the size of no unit.
    GRAVITY_OF_NO_UNIT = "gravity_of_no_unit" => error_by(
        "at rest the accelerometer's readings have the length {radius}, which is gravity in no unit that the program knows. They may be raw whole numbers (counts)",
        vec![Remedy::examples([
            (OptionName::AccelUnit, "counts"),
            (OptionName::AccelUnit, "m/s^2"),
        ])],
    ),
    /// The file states a unit that is not known.
    UNIT_STRANGE = "unit_strange" => error_by(
        "the file states {unit} for the {sensor}, which is no unit that the program knows. The readings do not show their unit either",
        vec![Remedy::examples([
            (OptionName::AccelUnit, "m/s^2"),
            (OptionName::GyroUnit, "deg/s"),
            (OptionName::Columns, "ax=NAME*0.001"),
        ])],
    ),
    /// The accelerometer lacks gravity.
    GRAVITY_REMOVED = "gravity_removed" => error(
        "the accelerometer's readings have a median length of {norm} {unit}: gravity has been removed, and calibration needs it",
        "record the accelerometer with gravity (\"total\", \"uncalibrated\" or \"with g\")",
    ),
    /// Forces are given in axes of the room.
    AXES_OF_THE_ROOM = "axes_of_the_room" => error(
        "by the gyroscope the device was turned over {turns} times, by up to {angle}, and at rest the accelerometer always reads the same: its readings are given in axes of the room and not of the device",
        "record the accelerometer in the axes of the device (\"raw\" or \"uncalibrated\"; not \"world\", \"earth\" or \"global\")",
    ),
    /// Angles stand in the columns of the rates.
    ANGLES_FOR_RATES = "angles_for_rates" => error_with(
        "at rest the gyroscope reads another value in each placement, over a range of {range}, as angles (roll, pitch, yaw) do: these are no rates of rotation",
        "record the gyroscope (\"angular velocity\", \"rotation rate\" or \"gyro\"), not the orientation",
        vec![Remedy::set(OptionName::Columns)],
    ),
    /// The accelerometer was normalised to a direction.
    NORMALISED = "normalised" => error(
        "the accelerometer's readings have the same length, {length}, in every row, while the device turns too: they were normalised to a direction, and no force is left in them",
        "record the accelerometer before it is normalised (\"raw\" or \"uncalibrated\")",
    ),
    /// Gravity has the size of another unit.
    GRAVITY_IN_OTHER_UNIT = "gravity_in_other_unit" => error_by(
        "at rest the accelerometer reads {radius} in all orientations. That is gravity in {right}, and {by} says {unit}",
        vec![Remedy::set_to(OptionName::AccelUnit, "g")],
    ),
    /// Gravity has the size of no unit, and one was stated.
    GRAVITY_OFF = "gravity_off" => error_by(
        "at rest the accelerometer reads {radius} in all orientations, which is {ratio} times gravity in {unit}, as {by} says. They may be raw whole numbers (counts)",
        vec![Remedy::set_to(OptionName::AccelUnit, "counts")],
    ),
    /// The gyroscope turns too fast for the stated unit.
    TURNS_IMPOSSIBLE = "turns_impossible" => error_by(
        "the file states {unit} for the gyroscope. In that unit the device would often turn faster than {fastest}, as no hand turns it",
        vec![Remedy::examples([
            (OptionName::GyroUnit, "deg/s"),
            (OptionName::GyroUnit, "counts"),
        ])],
    ),
    /// Turns have the size of another unit.
    TURNS_IN_OTHER_UNIT = "turns_in_other_unit" => error_by(
        "{by} {unit} for the gyroscope. But its turns agree with those that the accelerometer saw only in {told}",
        vec![Remedy::such_as(OptionName::GyroUnit, "deg/s")],
    ),
    /// Turns have the size of no unit.
    TURNS_OFF = "turns_off" => error_with(
        "{by} {unit} for the gyroscope. But the accelerometer saw turns about {factor} times as far, so the unit of the gyroscope or of the time stamps is wrong",
        "look both units up in the documentation of what wrote the file, and give the right one",
        vec![Remedy::examples([
            (OptionName::TimeUnit, "us"),
            (OptionName::GyroUnit, "counts"),
            (OptionName::Columns, "t=NAME"),
        ])],
    ),
    /// Nothing tells the gyroscope's unit, and that of the calibration's recording was none that can be assumed.
    UNIT_UNTOLD = "unit_untold" => error_by(
        "neither the file nor the readings tell the unit of the gyroscope[, and the recording of the calibration was in {other}][. In {faster}, as the recording of the calibration, the device would turn faster than gyroscopes can read][. In {still}, unlike the recording of the calibration, it would have the bias of the calibration]",
        vec![Remedy::such_as(OptionName::GyroUnit, "deg/s")],
    ),
    /// A gyroscope at rest reads what none reads in its unit.
    RESTLESS_REST = "restless_rest" => error_by(
        "the device never turns, so that no turn shows the gyroscope's unit. In {unit} its noise would be {noise} and its bias (mean at rest) {bias}, as no gyroscope has",
        vec![Remedy::such_as(OptionName::GyroUnit, "deg/s")],
    ),
    /// The sensors have each other's names.
    SENSORS_SWAPPED = "sensors_swapped" => error(
        "the columns of the gyroscope turn with gravity from rest to rest, and those of the accelerometer do not: their names are swapped",
        "[give {files} the other way round]",
    ),
    /// Readings under the names of a gyroscope are those of an accelerometer.
    FORCE_AS_RATE = "force_as_rate" => error_with(
        "the columns of the gyroscope keep the length {length} whatever the attitude, as gravity does: they hold no rates",
        "name them as the accelerometer's; if they do hold a gyroscope, give its unit",
        vec![Remedy::examples([
            (OptionName::Columns, "ax=NAME,ay=NAME,az=NAME"),
            (OptionName::GyroUnit, "rad/s"),
        ])],
    ),
    /// The gyroscope's unit changes within a file.
    RATE_UNIT_CHANGES = "rate_unit_changes" => error(
        "the gyroscope's turns are those that the accelerometer saw in {from} up to t = {until}, and in {to} from t = {since} on",
        "convert the readings to one unit, or split the file there",
    ),
}
