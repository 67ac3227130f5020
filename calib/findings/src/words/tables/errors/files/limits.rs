//! Words of errors: limits on how much is read.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ReadingStopped,
        "reading stopped in the middle of the file: {reason}",
        "copy the file again, for it may be incomplete",
        Vec::new,
    ),
    Entry::error(
        Kind::ReaderGaveUp,
        "the reader of this format gave up: the file is damaged in a way that it does not understand",
        "",
        || vec![Remedy::ExportAgain],
    ),
    Entry::error(
        Kind::PieceTooLong,
        "the file is damaged or of another format: it announces {bytes:byte} at this place, more than any recording has in one piece",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::EntriesTooMany,
        "the file or folder holds more than {limit} {things}, as no recording does",
        "export the recording to a file of its own",
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
        "{what} unpacks to more than {ratio} times its size, as no recording does; the program refuses it",
        "",
        || vec![Remedy::UnpackFirst],
    ),
    Entry::error(
        Kind::ContentTooLarge,
        "the file holds {what} of more than {limit:byte}",
        "",
        || vec![Remedy::set(OptionName::MaxBytes)],
    ),
    Entry::error(
        Kind::SamplesTooMany,
        "the recording has more than {limit:sample} of {stream}",
        "",
        || vec![Remedy::set(OptionName::MaxRows)],
    ),
    Entry::error(
        Kind::TableTooLong,
        "the file has a table of {rows:row}, and the limit is {limit}",
        "",
        || vec![Remedy::set(OptionName::MaxRows)],
    ),
    Entry::error(
        Kind::CellsTooMany,
        "the file is damaged or forged: it announces a table of {cells:cell} in {length:byte}, as no recording is",
        "copy or export the file again",
        Vec::new,
    ),
];
