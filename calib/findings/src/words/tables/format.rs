//! Words of how a file was read and of what in it is damaged.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, care, remark};

/// When the end of a recording is not missed.
const ALL_FOUND: &str =
    "nothing has to be done if the program finds all placements that you made; else record again";

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::TextEncoding => Entry {
            reason: "the file is in {encoding}",
            text: "{part} is not in UTF-8. The program reads it as {encoding}",
            ..remark(0.001)
        },
        Kind::NameMisleads => Entry {
            reason: "the file is text in spite of its name",
            text: "the file holds text in spite of its name, .{extension}. The program reads it as text",
            ..remark(0.001)
        },
        Kind::NumberSpelling => Entry {
            reason: "numbers are spelt in another way",
            text: "the program reads {spelling} as {read_as}",
            ..remark(0.001)
        },
        Kind::RowCut => Entry {
            reason: "the {which} row is cut and left out",
            text: "the {which} row is cut short[ (line {line})][ ({why})]. The program leaves it out",
            ..remark(0.001)
        },
        Kind::HeadersLeftOut => Entry {
            reason: "the header comes again",
            text: "the header of line {header_line} comes again {count:time}, first in line {line}. The program leaves these lines out",
            ..remark(0.001)
        },
        Kind::RowsBroken => Entry {
            reason: "broken rows were left out",
            text: "the file is damaged: {count:broken row} left out",
            remedies: vec![Remedy::ExportAgain],
            ..remark(0.05)
        },
        Kind::RowsWithoutNumbers => Entry {
            reason: "rows without all numbers were left out",
            text: "numbers are missing in the file: {count:row} with missing numbers left out",
            ..remark(0.001)
        },
        Kind::ColumnsByUnit => Entry {
            reason: "the program chose the columns by their units",
            text: "the program chose the columns by their units: {columns}",
            remedies: vec![Remedy::if_wrong([OptionName::Columns])],
            ..remark(0.001)
        },
        Kind::ColumnsByReadings => Entry {
            reason: "the columns have no names, and the program chose them by their readings",
            text: "the file has no header: columns taken as {columns}[. The mean of {turning} changes its direction from \
               rest to rest, as only an accelerometer's does]",
            remedies: vec![Remedy::if_wrong([OptionName::Columns])],
            ..remark(0.001)
        },
        Kind::FieldLeftOut => Entry {
            reason: "the magnetometer could not be read",
            text: "the magnetometer could not be read and is left out: {why}",
            ..remark(0.001)
        },
        Kind::FieldNotRead => Entry {
            reason: "columns of a magnetometer are not read",
            text: "the columns {columns} look like a magnetometer's. The program does not read them",
            ..remark(0.001)
        },
        Kind::StreamsChosen => Entry {
            reason: "some of the recorded sensors were taken",
            text: "the recording of {system} holds more sensors than the program reads. It takes {streams}",
            ..remark(0.001)
        },
        Kind::FileCut => Entry {
            reason: "the file is cut short",
            text: "the file ends within {within}[ at byte {byte}][ in line {line}]. The program has read what comes \
               before. The end of the recording may be missing",
            advice: ALL_FOUND,
            ..remark(0.05)
        },
        Kind::FileNotClosed => Entry {
            reason: "the recording was not closed properly",
            text: "the file ends without a footer at byte {byte}: the recording was not closed properly. The end of the \
               recording may be missing",
            advice: ALL_FOUND,
            ..remark(0.001)
        },
        Kind::FileDamaged => Entry {
            reason: "the file is damaged",
            text: "the file is damaged from byte {byte} on[ ({why})]. The program has read what comes before. The end of \
               the recording may be missing",
            remedies: vec![Remedy::ExportAgain],
            ..remark(0.05)
        },
        Kind::ChunkDamaged => Entry {
            reason: "a part of the file is damaged and left out",
            text: "a part (chunk) of the file is damaged at byte {byte}[ ({why})]. The program leaves it out",
            remedies: vec![Remedy::ExportAgain],
            ..remark(0.05)
        },
        Kind::BytesSkipped => Entry {
            reason: "a part of the file is damaged and skipped",
            text: "{count:byte} from byte {byte} on are no messages of the log. The program skips them",
            remedies: vec![Remedy::ExportAgain],
            ..remark(0.05)
        },
        Kind::VariableNotRead => Entry {
            reason: "a variable could not be read",
            text: "the program does not read the variable {variable}, because it is an object of class {class}",
            ..remark(0.001)
        },
        Kind::VariablesUnknown => Entry {
            reason: "no variable is called as a sensor is",
            text: "the file has no variable with a name that the program knows. It reads matrices `acc` and `gyro` with the columns t, x, y, z, or `t`, `acc` and `gyro` apart, or `t`, `ax` to `gz`, or a structure with such fields",
            advice: "rename the variables",
            ..care(1.0)
        },
        Kind::SheetHidden => Entry {
            reason: "a hidden sheet was left out",
            text: "the sheet {sheet} is hidden. The program leaves it out",
            ..remark(0.001)
        },
        Kind::EntryOutside => Entry {
            reason: "an entry of the archive was left out",
            text: "the path of the entry `{entry}` leads outside of the archive. The program leaves the entry out",
            ..remark(0.001)
        },
        _ => return None,
    })
}
