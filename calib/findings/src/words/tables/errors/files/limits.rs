//! Words of errors: limits on how much is read.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ReadingStopped => error(
            "reading stopped in the middle of the file: {reason}",
            "copy the file again, for it may be incomplete",
        ),
        Kind::ReaderGaveUp => error_by(
            "the reader of this format gave up: the file is damaged in a way that it does not understand",
            vec![Remedy::ExportAgain],
        ),
        Kind::PieceTooLong => error(
            "the file is damaged or of another format: it announces {bytes:byte} at this place, more than any recording has in one piece",
            "copy or export the file again",
        ),
        Kind::EntriesTooMany => error(
            "the file or folder holds more than {limit} {things}, as no recording does",
            "export the recording to a file of its own",
        ),
        Kind::UnpacksTooLarge => error_by(
            "{what} unpacks to more than {limit:byte}[: {total}]",
            vec![Remedy::UnpackFirst, Remedy::set(OptionName::MaxBytes)],
        ),
        Kind::UnpacksTooMuch => error_by(
            "{what} unpacks to more than {ratio} times its size, as no recording does; the program refuses it",
            vec![Remedy::UnpackFirst],
        ),
        Kind::ContentTooLarge => error_by(
            "the file holds {what} of more than {limit:byte}",
            vec![Remedy::set(OptionName::MaxBytes)],
        ),
        Kind::SamplesTooMany => error_by(
            "the recording has more than {limit:sample} of {stream}",
            vec![Remedy::set(OptionName::MaxRows)],
        ),
        Kind::TableTooLong => error_by(
            "the file has a table of {rows:row}, and the limit is {limit}",
            vec![Remedy::set(OptionName::MaxRows)],
        ),
        Kind::CellsTooMany => error(
            "the file is damaged or forged: it announces a table of {cells:cell} in {length:byte}, as no recording is",
            "copy or export the file again",
        ),
        _ => return None,
    })
}
