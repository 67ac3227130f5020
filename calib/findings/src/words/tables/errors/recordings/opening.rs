//! Words of what cannot be opened, or holds nothing.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::FileMissing,
        "the file cannot be opened: {reason}[, in {folder}][; nearest: {nearest}]",
        "check the name and the folder",
        Vec::new,
    ),
    Entry::error(
        Kind::LinkToNothing,
        "the file cannot be opened: {reason}[, in {folder}]; it is a link to nothing",
        "name the file itself, or mend the link",
        Vec::new,
    ),
    Entry::error(
        Kind::EmptyFile,
        "the file is empty",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::EmptyInput,
        "standard input is empty",
        "pipe a recording into it",
        Vec::new,
    ),
    Entry::error(
        Kind::InputIsTerminal,
        "`-` is standard input, and that is a terminal",
        "pipe a recording into it",
        Vec::new,
    ),
    Entry::error(
        Kind::FileTooLarge,
        "the file has {size}, more than the limit of {limit}. Its rows (about {rows}) need {memory} of memory",
        "",
        || vec![Remedy::set(OptionName::MaxBytes)],
    ),
    Entry::error(
        Kind::TooManyBytes,
        "the file has more than {limit} bytes[ of {what}], the most that the program reads",
        "cut the recording into parts",
        || vec![Remedy::such_as(OptionName::MaxBytes, "40000000000")],
    ),
    Entry::error(
        Kind::SeveralFiles,
        "this is {holder}, where one table was expected",
        "name the one file that is meant",
        Vec::new,
    ),
    Entry::error(
        Kind::NoText,
        "this file is no text, where a table of one sensor was expected",
        "name a text table, such as CSV, for each sensor; a recording of both sensors in one file is named by itself",
        Vec::new,
    ),
    Entry::error(
        Kind::UnknownFormat,
        "this file is of no known format",
        "export it as CSV with the header t,ax,ay,az,gx,gy,gz",
        Vec::new,
    ),
    Entry::error(
        Kind::NoFormat,
        "there is no format `{format}`; known: {known}",
        "choose one of these",
        Vec::new,
    ),
    Entry::error(
        Kind::OtherFormat,
        "the format {format} was asked for, which reads {expected}, and this file is none",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Format,
            }]
        },
    ),
    Entry::error(
        Kind::FileChanged,
        "the file changed while it was read",
        "wait until it is complete, or copy it first",
        Vec::new,
    ),
    Entry::error(
        Kind::ReadTwice,
        "the sensors of this recording have clocks of their own, so that the program reads it twice, and a stream can be read once only",
        "save it to a file and name that",
        Vec::new,
    ),
    Entry::error(
        Kind::FolderAsFile,
        "this is a folder, where a file was expected",
        "name a file in it",
        Vec::new,
    ),
    Entry::error(
        Kind::TextTooLarge,
        "the file has more than 64 MiB: this is no calibration, spec or effect file",
        "name another file",
        Vec::new,
    ),
    Entry::error(
        Kind::NotUtf8,
        "no UTF-8 text is in this line: the file is another one, is damaged, or has another encoding",
        "name the right file if this is another; if it is the right one, copy it again or save it as UTF-8 in a text editor",
        Vec::new,
    ),
    Entry::error(
        Kind::BinaryData,
        "the text has binary data at byte {at_byte}, as a damaged file or one of another format has",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::LineTooLong,
        "the file has a line of more than 1 MiB: this is no recording in text",
        "name another file",
        Vec::new,
    ),
    Entry::error(
        Kind::OnlyComments,
        "the file begins with 64 MiB of comments and no row: is this no recording?",
        "delete the comments",
        Vec::new,
    ),
    Entry::error(
        Kind::NoData,
        "the file has no data: nothing but blank and comment lines",
        "name a file with rows of readings",
        Vec::new,
    ),
    Entry::error(
        Kind::NoRows,
        "[{found} found, ]no data rows",
        "copy or export the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::TooManyRows,
        "the recording has more than {limit} rows, the most that the program reads",
        "cut the recording into parts",
        || vec![Remedy::such_as(OptionName::MaxRows, "400000000")],
    ),
    Entry::error(
        Kind::TooLargeForMemory,
        "about {rows} rows need {size} of memory, more than the system grants",
        "cut the recording into parts, or raise the limit (ulimit -v)",
        Vec::new,
    ),
    Entry::error(
        Kind::OutOfMemory,
        "not enough memory for more rows",
        "cut the recording here, or raise the limit (ulimit -v)",
        Vec::new,
    ),
];
