//! Words of errors: damage that every format can have.

use crate::remedy::Remedy;
use crate::words::entry::{error, error_by};

kinds! {
    /// A part of a file is damaged.
    PART_DAMAGED = "part_damaged" => error(
        "the file is damaged: its {part}[ of the {whole}] cannot be read",
        "copy or export the file again",
    ),
    /// A part of a file ends too early.
    PART_CUT = "part_cut" => error_by(
        "the file is cut short within the {part} of the {whole}",
        vec![Remedy::CopyAgain],
    ),
    /// A packed part of a file cannot be unpacked.
    PART_UNPACKS_NOT = "part_unpacks_not" => error_by(
        "the file is damaged: its {part} cannot be unpacked ({reason})",
        vec![Remedy::CopyAgain],
    ),
    /// A part of a file has another length than is stated.
    LENGTH_CONTRADICTED = "length_contradicted" => error(
        "the file is damaged: its {part} is {than} than {stated} says",
        "copy or export the file again",
    ),
    /// A part of a file unpacks to another length than is stated.
    UNPACKED_LENGTH = "unpacked_length" => error(
        "the file is damaged: its {part} unpacks to {bytes:byte}, {expected} expected",
        "copy or export the file again",
    ),
    /// The check sum of a part of a file is wrong.
    CHECK_SUM_WRONG = "check_sum_wrong" => error(
        "the {part} of the file is damaged: its check sum (CRC) is wrong",
        "copy or export the file again",
    ),
    /// A part of a file ends within a record.
    ENDS_WITHIN_RECORD = "ends_within_record" => error(
        "the file is cut short: it ends within a record",
        "copy or export the file again",
    ),
    /// Values within values are deeper than any recording's.
    NESTED_TOO_DEEP = "nested_too_deep" => error(
        "the file has more than {limit} {things} within each other, as no recording has",
        "export the recording as CSV",
    ),
    /// The parser of a format refuses a file.
    FORMAT_UNREADABLE = "format_unreadable" => error(
        "the {format} cannot be read: {reason}",
        "copy or export the file again",
    ),
    /// The writer of a format refuses a recording.
    FORMAT_UNWRITABLE = "format_unwritable" => error(
        "the {format} cannot be written: {reason}",
        "choose another format",
    ),
    /// Columns of one table differ in length.
    COLUMNS_UNEQUAL = "columns_unequal" => error(
        "[{name}: ]the columns have unequal lengths[: {listed}]",
        "export the file with one length for all columns",
    ),
    /// A file is compressed in a way that is not read.
    COMPRESSION_UNKNOWN = "compression_unknown" => error(
        "the {part} of the file is compressed by `{method}`, which the program does not read[; it reads {known}]",
        "write the file again without this compression",
    ),
}
