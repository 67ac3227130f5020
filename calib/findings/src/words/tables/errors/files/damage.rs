//! Words of errors: damage that every format can have.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::PartDamaged,
        "a damaged {part}[ of the {whole}]",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PartCut,
        "the {part} of the {whole} is cut short",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::PartUnpacksNot,
        "the {part} is damaged and cannot be unpacked: {reason}",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::LengthContradicted,
        "the {part} is {than} than {stated} says",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::UnpackedLength,
        "the {part} unpacks to {bytes:byte}, {expected} expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::CheckSumWrong,
        "the {part} is damaged: its check sum (CRC) is wrong",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::EndsWithinRecord,
        "it ends within a record",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NestedTooDeep,
        "more than {limit} {things} within each other",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::FormatUnreadable,
        "the {format} cannot be read: {reason}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::FormatUnwritable,
        "the {format} cannot be written: {reason}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ColumnsUnequal,
        "[{name}: ]columns of unequal length[: {listed}]",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::CompressionUnknown,
        "the {part} is compressed by `{method}`, which is not read[; {known} are]",
        "",
        Vec::new,
    ),
];
