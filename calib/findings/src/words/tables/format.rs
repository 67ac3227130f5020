//! Words of how a file was read and of what in it is damaged.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::TextEncoding,
        level: Level::Remark,
        severity: 0.001,
        reason: "the file is in {encoding}",
        text: "{part} is not in UTF-8: read as {encoding}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NameMisleads,
        level: Level::Remark,
        severity: 0.001,
        reason: "the file is text in spite of its name",
        text: "text in spite of its name, .{extension}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NumberSpelling,
        level: Level::Remark,
        severity: 0.001,
        reason: "numbers are spelt in another way",
        text: "{spelling} are read as {read_as}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::RowCut,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {which} row is cut and left out",
        text: "the {which} row is cut short and left out[: line {line}][: {why}]",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::RowsBroken,
        level: Level::Remark,
        severity: 0.05,
        reason: "broken rows were left out",
        text: "{count:broken row} left out",
        remedies: || vec![Remedy::ExportAgain],
    },
    Entry {
        kind: Kind::RowsWithoutNumbers,
        level: Level::Remark,
        severity: 0.001,
        reason: "rows without all numbers were left out",
        text: "{count:row} with missing numbers left out",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ColumnsByUnit,
        level: Level::Remark,
        severity: 0.001,
        reason: "the columns were told by their units",
        text: "columns taken by their units: {columns}",
        remedies: || vec![Remedy::if_wrong([OptionName::Columns])],
    },
    Entry {
        kind: Kind::ColumnsByReadings,
        level: Level::Remark,
        severity: 0.001,
        reason: "the columns have no names and were told by their readings",
        text: "no header: columns taken as {columns}[. The mean of {turning} turns from rest to rest, as only an \
               accelerometer's does]",
        remedies: || vec![Remedy::if_wrong([OptionName::Columns])],
    },
    Entry {
        kind: Kind::FieldLeftOut,
        level: Level::Remark,
        severity: 0.001,
        reason: "the magnetometer could not be read",
        text: "the magnetometer is left out: {why}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FieldNotRead,
        level: Level::Remark,
        severity: 0.001,
        reason: "columns of a magnetometer are not read",
        text: "the columns {columns} look like a magnetometer's and are not read",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StreamsChosen,
        level: Level::Remark,
        severity: 0.001,
        reason: "some of the recorded sensors were taken",
        text: "the recording of {system} holds more than is read: taken are {streams}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FileCut,
        level: Level::Remark,
        severity: 0.05,
        reason: "the file is cut short",
        text: "the file ends within {within}[ at byte {byte}][ in line {line}]: what is before is read, and the recording \
               may be shorter than it was",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::FileNotClosed,
        level: Level::Remark,
        severity: 0.001,
        reason: "the file was not closed",
        text: "the file ends without a footer at byte {byte}: the recording was not closed, and may be shorter than it was",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FileDamaged,
        level: Level::Remark,
        severity: 0.05,
        reason: "the file is damaged",
        text: "the file is damaged from byte {byte} on: what is before is read, and the recording may be shorter than it \
               was ({why})",
        remedies: || vec![Remedy::ExportAgain],
    },
    Entry {
        kind: Kind::ChunkDamaged,
        level: Level::Remark,
        severity: 0.05,
        reason: "a part of the file is damaged and left out",
        text: "at byte {byte} a chunk is damaged and left out[ ({why})]",
        remedies: || vec![Remedy::ExportAgain],
    },
    Entry {
        kind: Kind::BytesSkipped,
        level: Level::Remark,
        severity: 0.05,
        reason: "a part of the file is damaged and skipped",
        text: "{count:byte} from byte {byte} on are no messages and are skipped",
        remedies: || vec![Remedy::ExportAgain],
    },
    Entry {
        kind: Kind::VariableNotRead,
        level: Level::Remark,
        severity: 0.001,
        reason: "a variable could not be read",
        text: "the variable {variable} is an object of class {class} and is not read",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::VariablesUnknown,
        level: Level::Care,
        severity: 1.0,
        reason: "no variable is called as a sensor is",
        text: "read are matrices `acc` and `gyro` with the columns t, x, y, z, or `t`, `acc` and `gyro` apart, or `t`, `ax` \
               to `gz`; save('FILE', '-struct', 'S') writes the fields of a structure S as variables",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::SheetHidden,
        level: Level::Remark,
        severity: 0.001,
        reason: "a hidden sheet was left out",
        text: "the sheet {sheet} is hidden and is left out",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::EntryOutside,
        level: Level::Remark,
        severity: 0.001,
        reason: "an entry of the archive was left out",
        text: "entry `{entry}` lies outside of the archive and is left out",
        remedies: Vec::new,
    },
];
