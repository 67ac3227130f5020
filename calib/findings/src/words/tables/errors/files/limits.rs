//! Words of errors: limits on how much is read.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by};

kinds! {
    /// The system stopped the reading of a file.
    READING_STOPPED = "reading_stopped" => error(
        "reading stopped in the middle of the file: {reason}",
        "copy the file again, for it may be incomplete",
    ),
    /// A reader gave up at damage that it does not understand.
    READER_GAVE_UP = "reader_gave_up" => error_by(
        "the reader of this format gave up: the file is damaged in a way that it does not understand",
        vec![Remedy::ExportAgain],
    ),
    /// A piece of a file announces more bytes than any recording has.
    PIECE_TOO_LONG = "piece_too_long" => error(
        "the file is damaged or of another format: it announces {bytes:byte} at this place, more than any recording has in one piece",
        "copy or export the file again",
    ),
    /// A folder or a file has more entries than any recording.
    ENTRIES_TOO_MANY = "entries_too_many" => error(
        "the file or folder holds more than {limit} {things}, as no recording does",
        "export the recording to a file of its own",
    ),
    /// Something unpacks to more bytes than are read.
    UNPACKS_TOO_LARGE = "unpacks_too_large" => error_by(
        "{what} unpacks to more than {limit:byte}[: {total}]",
        vec![Remedy::UnpackFirst, Remedy::set(OptionName::MaxBytes)],
    ),
    /// Something unpacks to more times its size than any recording.
    UNPACKS_TOO_MUCH = "unpacks_too_much" => error_by(
        "{what} unpacks to more than {ratio} times its size, as no recording does; the program refuses it",
        vec![Remedy::UnpackFirst],
    ),
    /// A content that is held as a whole is too large.
    CONTENT_TOO_LARGE = "content_too_large" => error_by(
        "the file holds {what} of more than {limit:byte}",
        vec![Remedy::set(OptionName::MaxBytes)],
    ),
    /// A stream has more samples than are read.
    SAMPLES_TOO_MANY = "samples_too_many" => error_by(
        "the recording has more than {limit:sample} of {stream}",
        vec![Remedy::set(OptionName::MaxRows)],
    ),
    /// A table has more rows than are read.
    TABLE_TOO_LONG = "table_too_long" => error_by(
        "the file has a table of {rows:row}, and the limit is {limit}",
        vec![Remedy::set(OptionName::MaxRows)],
    ),
    /// A table announces more cells than its file can hold.
    CELLS_TOO_MANY = "cells_too_many" => error(
        "the file is damaged or forged: it announces a table of {cells:cell} in {length:byte}, as no recording is",
        "copy or export the file again",
    ),
}
