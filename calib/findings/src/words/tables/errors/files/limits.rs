//! Words of errors: limits on how much is read.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ReadingStopped,
        "reading stopped: {reason}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ReaderGaveUp,
        "the reader of this format gave up at damage that it does not understand",
        "",
        || vec![Remedy::ExportAgain],
    ),
    Entry::error(
        Kind::PieceTooLong,
        "{bytes:byte} are announced here, more than any recording has in one piece",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::EntriesTooMany,
        "more than {limit} {things}, as no recording has",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::UnpacksTooLarge,
        "{what} unpacks to more than {limit:byte}[: {total}]",
        "",
        || vec![Remedy::UnpackFirst, Remedy::set(OptionName::MaxBytes)],
    ),
    Entry::error(
        Kind::UnpacksTooMuch,
        "{what} unpacks to more than {ratio} times its size, as no recording does",
        "",
        || vec![Remedy::UnpackFirst],
    ),
    Entry::error(
        Kind::ContentTooLarge,
        "{what} of more than {limit:byte}",
        "",
        || vec![Remedy::set(OptionName::MaxBytes)],
    ),
    Entry::error(
        Kind::SamplesTooMany,
        "more than {limit:sample} of {stream}",
        "",
        || vec![Remedy::set(OptionName::MaxRows)],
    ),
    Entry::error(
        Kind::TableTooLong,
        "a table of {rows:row}, more than {limit}",
        "",
        || vec![Remedy::set(OptionName::MaxRows)],
    ),
    Entry::error(
        Kind::CellsTooMany,
        "a table of {cells:cell} in a file of {length:byte}, as no recording is",
        "",
        Vec::new,
    ),
];
