//! Words of units that were told from the readings, or not.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, care, remark};

kinds! {
    /// The accelerometer's unit follows from the size of gravity.
    UNIT_BY_GRAVITY = "unit_by_gravity" => Entry {
        reason: "the program found the accelerometer's unit by gravity",
        text: "the accelerometer is taken as {unit}: its median length is then {norm}, near gravity",
        remedies: vec![Remedy::if_wrong([OptionName::AccelUnit])],
        ..remark(0.001)
    },
    /// The gyroscope's unit follows from the turns that the accelerometer saw.
    UNIT_BY_TURNS = "unit_by_turns" => Entry {
        reason: "the program found the gyroscope's unit by the turns",
        text: "the gyroscope is taken as {unit}: its turns are then those that the accelerometer saw",
        remedies: vec![Remedy::if_wrong([OptionName::GyroUnit])],
        ..remark(0.001)
    },
    /// The gyroscope's unit is a guess from its largest reading.
    UNIT_BY_SIZE = "unit_by_size" => Entry {
        reason: "the gyroscope's unit is only guessed from its largest reading",
        text: "the gyroscope is taken as {unit}, because its largest reading is {fastest}. That is a guess",
        remedies: vec![Remedy::set(OptionName::GyroUnit)],
        ..care(0.5)
    },
    /// Nothing tells the gyroscope's unit, and rad/s is assumed.
    UNIT_ASSUMED = "unit_assumed" => Entry {
        reason: "nothing tells the gyroscope's unit, and rad/s is assumed",
        text: "neither the file nor the readings tell the unit of the gyroscope. The program assumes rad/s",
        remedies: vec![Remedy::if_wrong([OptionName::GyroUnit])],
        ..remark(0.001)
    },
    /// The gyroscope's unit is that of the recording that the calibration was made from.
    UNIT_OF_CALIBRATION = "unit_of_calibration" => Entry {
        reason: "the gyroscope's unit is that of the calibration's own recording",
        text: "the gyroscope is taken as {unit}, like the recording of the calibration: the file names no unit",
        remedies: vec![Remedy::if_wrong([OptionName::GyroUnit])],
        ..remark(0.001)
    },
    /// The readings are raw counts and kept as they are.
    READ_AS_COUNTS = "read_as_counts" => Entry {
        reason: "the {sensor} is read as raw counts",
        text: "the {sensor} is taken as raw counts (numbers without a physical unit), which are kept as they are[: its \
           median length is {norm}][: it reaches {fastest}][: whole numbers, up to {at_rest} at rest]",
        ..remark(0.001)
    },
    /// A given unit is another than the file states.
    UNIT_OVERRIDDEN = "unit_overridden" => Entry {
        reason: "the given unit of {quantity} is another than the file states",
        text: "the unit of {quantity} is taken as {given}, as was said, though the file says {stated}",
        ..remark(0.001)
    },
    /// The units are those that such files usually have.
    UNITS_OF_FORMAT = "units_of_format" => Entry {
        reason: "the program uses the units that files of {system} have",
        text: "files of {system} state no units. The program reads stamps in {time} and rates in {rate}",
        remedies: vec![Remedy::if_wrong([
            OptionName::TimeUnit,
            OptionName::GyroUnit,
        ])],
        ..remark(0.001)
    },
    /// Temperatures are so high that they may be °F.
    TEMPERATURE_DOUBTFUL = "temperature_doubtful" => Entry {
        reason: "the temperatures may be °F",
        text: "temperatures of {least} to {most} are taken as °C, though in °F they would be {least_celsius} to \
           {most_celsius}",
        advice: "nothing has to be done if the values are in °C",
        remedies: vec![Remedy::NameUnit {
            example: "temp [F]".into(),
        }],
        ..remark(0.001)
    },
    /// Temperatures are counts of the sensor and no °C.
    TEMPERATURE_IN_COUNTS = "temperature_in_counts" => Entry {
        reason: "the temperatures are raw whole numbers and no °C",
        text: "the temperatures ({least} to {most}) are raw whole numbers of the sensor (counts) and no °C. The program leaves them out[. Formulas of data sheets make {formulas} of them]",
        advice: "if you want to use them, convert them to °C",
        ..remark(0.001)
    },
    /// Temperatures are beyond what a sensor stands.
    TEMPERATURE_IMPOSSIBLE = "temperature_impossible" => Entry {
        reason: "the temperatures cannot be °C",
        text: "the temperatures ({least} to {most}) cannot be °C: they are beyond -60 to 150. The program leaves them out[. A formula makes {formulas} of them]",
        advice: "if you want to use them, convert them to °C",
        remedies: vec![Remedy::NameUnit {
            example: "temp [K]".into(),
        }],
        ..remark(0.001)
    },
}
