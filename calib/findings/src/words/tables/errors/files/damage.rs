//! Words of errors: damage that every format can have.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::PartDamaged => error(
            "the file is damaged: its {part}[ of the {whole}] cannot be read",
            "copy or export the file again",
        ),
        Kind::PartCut => error_by(
            "the file is cut short within the {part} of the {whole}",
            vec![Remedy::CopyAgain],
        ),
        Kind::PartUnpacksNot => error_by(
            "the file is damaged: its {part} cannot be unpacked ({reason})",
            vec![Remedy::CopyAgain],
        ),
        Kind::LengthContradicted => error(
            "the file is damaged: its {part} is {than} than {stated} says",
            "copy or export the file again",
        ),
        Kind::UnpackedLength => error(
            "the file is damaged: its {part} unpacks to {bytes:byte}, {expected} expected",
            "copy or export the file again",
        ),
        Kind::CheckSumWrong => error(
            "the {part} of the file is damaged: its check sum (CRC) is wrong",
            "copy or export the file again",
        ),
        Kind::EndsWithinRecord => error(
            "the file is cut short: it ends within a record",
            "copy or export the file again",
        ),
        Kind::NestedTooDeep => error(
            "the file has more than {limit} {things} within each other, as no recording has",
            "export the recording as CSV",
        ),
        Kind::FormatUnreadable => error(
            "the {format} cannot be read: {reason}",
            "copy or export the file again",
        ),
        Kind::FormatUnwritable => error(
            "the {format} cannot be written: {reason}",
            "choose another format",
        ),
        Kind::ColumnsUnequal => error(
            "[{name}: ]the columns have unequal lengths[: {listed}]",
            "export the file with one length for all columns",
        ),
        Kind::CompressionUnknown => error(
            "the {part} of the file is compressed by `{method}`, which the program does not read[; it reads {known}]",
            "write the file again without this compression",
        ),
        _ => return None,
    })
}
