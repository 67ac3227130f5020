//! Words of how a file was read and of what in it is damaged.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, care, remark};

/// When the end of a recording is not missed.
const ALL_FOUND: &str =
    "nothing has to be done if the program finds all placements that you made; else record again";

kinds! {
    /// The text is in another encoding than UTF-8.
    TEXT_ENCODING = "text_encoding" => Entry {
        reason: "the file is in {encoding}",
        text: "{part} is not in UTF-8. The program reads it as {encoding}",
        ..remark(0.001)
    },
    /// The name of a file is that of another format.
    NAME_MISLEADS = "name_misleads" => Entry {
        reason: "the file is text in spite of its name",
        text: "the file holds text in spite of its name, .{extension}. The program reads it as text",
        ..remark(0.001)
    },
    /// Numbers are spelt in a way of their own.
    NUMBER_SPELLING = "number_spelling" => Entry {
        reason: "numbers are spelt in another way",
        text: "the program reads {spelling} as {read_as}",
        ..remark(0.001)
    },
    /// The first or the last row is cut.
    ROW_CUT = "row_cut" => Entry {
        reason: "the {which} row is cut and left out",
        text: "the {which} row is cut short[ (line {line})][ ({why})]. The program leaves it out",
        ..remark(0.001)
    },
    /// A logger writes its header again and again.
    HEADERS_LEFT_OUT = "headers_left_out" => Entry {
        reason: "the header comes again",
        text: "the header of line {header_line} comes again {count:time}, first in line {line}. The program leaves these lines out",
        ..remark(0.001)
    },
    /// Broken rows were left out.
    ROWS_BROKEN = "rows_broken" => Entry {
        reason: "broken rows were left out",
        text: "the file is damaged: {count:broken row} left out",
        remedies: vec![Remedy::ExportAgain],
        ..remark(0.05)
    },
    /// Rows lack numbers and were left out.
    ROWS_WITHOUT_NUMBERS = "rows_without_numbers" => Entry {
        reason: "rows without all numbers were left out",
        text: "numbers are missing in the file: {count:row} with missing numbers left out",
        ..remark(0.001)
    },
    /// Columns were taken by the units in their names.
    COLUMNS_BY_UNIT = "columns_by_unit" => Entry {
        reason: "the program chose the columns by their units",
        text: "the program chose the columns by their units: {columns}",
        remedies: vec![Remedy::if_wrong([OptionName::Columns])],
        ..remark(0.001)
    },
    /// Columns without names were taken by their readings.
    COLUMNS_BY_READINGS = "columns_by_readings" => Entry {
        reason: "the columns have no names, and the program chose them by their readings",
        text: "the file has no header: columns taken as {columns}[. The mean of {turning} changes its direction from \
           rest to rest, as only an accelerometer's does]",
        remedies: vec![Remedy::if_wrong([OptionName::Columns])],
        ..remark(0.001)
    },
    /// The magnetometer could not be read.
    FIELD_LEFT_OUT = "field_left_out" => Entry {
        reason: "the magnetometer could not be read",
        text: "the magnetometer could not be read and is left out: {why}",
        ..remark(0.001)
    },
    /// Columns look like a magnetometer's and are not read.
    FIELD_NOT_READ = "field_not_read" => Entry {
        reason: "columns of a magnetometer are not read",
        text: "the columns {columns} look like a magnetometer's. The program does not read them",
        ..remark(0.001)
    },
    /// Only some of several sensors in an app's recording were read.
    STREAMS_CHOSEN = "streams_chosen" => Entry {
        reason: "some of the recorded sensors were taken",
        text: "the recording of {system} holds more sensors than the program reads. It takes {streams}",
        ..remark(0.001)
    },
    /// The file ends too early.
    FILE_CUT = "file_cut" => Entry {
        reason: "the file is cut short",
        text: "the file ends within {within}[ at byte {byte}][ in line {line}]. The program has read what comes \
           before. The end of the recording may be missing",
        advice: ALL_FOUND,
        ..remark(0.05)
    },
    /// The recording program did not close the file.
    FILE_NOT_CLOSED = "file_not_closed" => Entry {
        reason: "the recording was not closed properly",
        text: "the file ends without a footer at byte {byte}: the recording was not closed properly. The end of the \
           recording may be missing",
        advice: ALL_FOUND,
        ..remark(0.001)
    },
    /// A part of the file is damaged.
    FILE_DAMAGED = "file_damaged" => Entry {
        reason: "the file is damaged",
        text: "the file is damaged from byte {byte} on[ ({why})]. The program has read what comes before. The end of \
           the recording may be missing",
        remedies: vec![Remedy::ExportAgain],
        ..remark(0.05)
    },
    /// A chunk of a log is damaged and left out.
    CHUNK_DAMAGED = "chunk_damaged" => Entry {
        reason: "a part of the file is damaged and left out",
        text: "a part (chunk) of the file is damaged at byte {byte}[ ({why})]. The program leaves it out",
        remedies: vec![Remedy::ExportAgain],
        ..remark(0.05)
    },
    /// Bytes of a log are no messages.
    BYTES_SKIPPED = "bytes_skipped" => Entry {
        reason: "a part of the file is damaged and skipped",
        text: "{count:byte} from byte {byte} on are no messages of the log. The program skips them",
        remedies: vec![Remedy::ExportAgain],
        ..remark(0.05)
    },
    /// A variable is of a class that is not read.
    VARIABLE_NOT_READ = "variable_not_read" => Entry {
        reason: "a variable could not be read",
        text: "the program does not read the variable {variable}, because it is an object of class {class}",
        ..remark(0.001)
    },
    /// No variable is called as a sensor is.
    VARIABLES_UNKNOWN = "variables_unknown" => Entry {
        reason: "no variable is called as a sensor is",
        text: "the file has no variable with a name that the program knows. It reads matrices `acc` and `gyro` with the columns t, x, y, z, or `t`, `acc` and `gyro` apart, or `t`, `ax` to `gz`, or a structure with such fields",
        advice: "rename the variables",
        ..care(1.0)
    },
    /// A hidden sheet of a workbook was left out.
    SHEET_HIDDEN = "sheet_hidden" => Entry {
        reason: "a hidden sheet was left out",
        text: "the sheet {sheet} is hidden. The program leaves it out",
        ..remark(0.001)
    },
    /// An entry of an archive lies outside of it.
    ENTRY_OUTSIDE = "entry_outside" => Entry {
        reason: "an entry of the archive was left out",
        text: "the path of the entry `{entry}` leads outside of the archive. The program leaves the entry out",
        ..remark(0.001)
    },
}
