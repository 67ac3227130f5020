//! Words of errors: damage that every format can have.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::PartDamaged,
        "the file is damaged: its {part}[ of the {whole}] cannot be read",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::PartCut,
        "the file is cut short within the {part} of the {whole}",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::PartUnpacksNot,
        "the file is damaged: its {part} cannot be unpacked ({reason})",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::LengthContradicted,
        "the file is damaged: its {part} is {than} than {stated} says",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::UnpackedLength,
        "the file is damaged: its {part} unpacks to {bytes:byte}, {expected} expected",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::CheckSumWrong,
        "the {part} of the file is damaged: its check sum (CRC) is wrong",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::EndsWithinRecord,
        "the file is cut short: it ends within a record",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::NestedTooDeep,
        "the file has more than {limit} {things} within each other, as no recording has",
        "export the recording as CSV",
        Vec::new,
    ),
    Entry::error(
        Kind::FormatUnreadable,
        "the {format} cannot be read: {reason}",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::FormatUnwritable,
        "the {format} cannot be written: {reason}",
        "choose another format",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsUnequal,
        "[{name}: ]the columns have unequal lengths[: {listed}]",
        "export the file with one length for all columns",
        Vec::new,
    ),
    Entry::error(
        Kind::CompressionUnknown,
        "the {part} of the file is compressed by `{method}`, which the program does not read[; it reads {known}]",
        "write the file again without this compression",
        Vec::new,
    ),
];
