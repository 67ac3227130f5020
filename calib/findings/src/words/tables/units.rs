//! Words of units that were told from the readings, or not.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::UnitByGravity,
        level: Level::Remark,
        severity: 0.001,
        reason: "the program found the accelerometer's unit by gravity",
        text: "the accelerometer is taken as {unit}: its median length is then {norm}, near gravity",
        advice: "",
        remedies: || vec![Remedy::if_wrong([OptionName::AccelUnit])],
    },
    Entry {
        kind: Kind::UnitByTurns,
        level: Level::Remark,
        severity: 0.001,
        reason: "the program found the gyroscope's unit by the turns",
        text: "the gyroscope is taken as {unit}: its turns are then those that the accelerometer saw",
        advice: "",
        remedies: || vec![Remedy::if_wrong([OptionName::GyroUnit])],
    },
    Entry {
        kind: Kind::UnitBySize,
        level: Level::Care,
        severity: 0.5,
        reason: "the gyroscope's unit is only guessed from its largest reading",
        text: "the gyroscope is taken as {unit}, because its largest reading is {fastest}. That is a guess",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::GyroUnit)],
    },
    Entry {
        kind: Kind::ReadAsCounts,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} is read as raw counts",
        text: "the {sensor} is taken as raw counts (numbers without a physical unit), which are kept as they are[: its \
               median length is {norm}][: it reaches {fastest}][: whole numbers, up to {at_rest} at rest]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::UnitOverridden,
        level: Level::Remark,
        severity: 0.001,
        reason: "the given unit of {quantity} is another than the file states",
        text: "the unit of {quantity} is taken as {given}, as was said, though the file says {stated}",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::UnitsOfFormat,
        level: Level::Remark,
        severity: 0.001,
        reason: "the program uses the units that files of {system} have",
        text: "files of {system} state no units. The program reads stamps in {time} and rates in {rate}",
        advice: "",
        remedies: || {
            vec![Remedy::if_wrong([
                OptionName::TimeUnit,
                OptionName::GyroUnit,
            ])]
        },
    },
    Entry {
        kind: Kind::TemperatureDoubtful,
        level: Level::Remark,
        severity: 0.001,
        reason: "the temperatures may be °F",
        text: "temperatures of {least} to {most} are taken as °C, though in °F they would be {least_celsius} to \
               {most_celsius}",
        advice: "nothing has to be done if the values are in °C",
        remedies: || {
            vec![Remedy::NameUnit {
                example: "temp [F]".into(),
            }]
        },
    },
    Entry {
        kind: Kind::TemperatureInCounts,
        level: Level::Remark,
        severity: 0.001,
        reason: "the temperatures are raw whole numbers and no °C",
        text: "the temperatures ({least} to {most}) are raw whole numbers of the sensor (counts) and no °C. The program leaves them out[. Formulas of data sheets make {formulas} of them]",
        advice: "if you want to use them, convert them to °C",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TemperatureImpossible,
        level: Level::Remark,
        severity: 0.001,
        reason: "the temperatures cannot be °C",
        text: "the temperatures ({least} to {most}) cannot be °C: they are beyond -60 to 150. The program leaves them out[. A formula makes {formulas} of them]",
        advice: "if you want to use them, convert them to °C",
        remedies: || {
            vec![Remedy::NameUnit {
                example: "temp [K]".into(),
            }]
        },
    },
];
