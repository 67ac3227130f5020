//! Words of what cannot be opened, or holds nothing.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::FileMissing,
        "{reason}[, in {folder}][; nearest: {nearest}]",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::LinkToNothing,
        "{reason}[, in {folder}]; it is a link to nothing",
        "",
        Vec::new,
    ),
    Entry::error(Kind::EmptyFile, "file is empty", "", Vec::new),
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
        "{size}, about {rows} rows that need {memory} of memory; the limit is {limit}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TooManyBytes,
        "more than {limit} bytes[ of {what}]",
        "",
        || vec![Remedy::set(OptionName::MaxBytes)],
    ),
    Entry::error(
        Kind::SeveralFiles,
        "{holder}, where one table was expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoText,
        "no text, where a table of one sensor was expected",
        "name the file by itself",
        Vec::new,
    ),
    Entry::error(Kind::UnknownFormat, "of no known format", "", Vec::new),
    Entry::error(
        Kind::NoFormat,
        "no format `{format}`; known: {known}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::OtherFormat,
        "the format {format} reads {expected}, and this is none",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Format,
            }]
        },
    ),
    Entry::error(
        Kind::FileChanged,
        "changed while it was read",
        "wait until it is complete, or copy it first",
        Vec::new,
    ),
    Entry::error(
        Kind::ReadTwice,
        "its sensors have clocks of their own, so that it is read twice",
        "save it to a file and name that",
        Vec::new,
    ),
    Entry::error(
        Kind::FolderAsFile,
        "a folder, where a file was expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TextTooLarge,
        "more than 64 MiB: this is no calibration, spec or effect file",
        "name another file",
        Vec::new,
    ),
    Entry::error(
        Kind::NotUtf8,
        "no UTF-8 text: is this another file, or damaged?",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::BinaryData,
        "binary data at byte {at_byte}: truncated or wrong format?",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::LineTooLong,
        "a line of more than 1 MiB: this is no recording in text",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::OnlyComments,
        "64 MiB of comments and no row: is this no recording?",
        "delete the comments",
        Vec::new,
    ),
    Entry::error(
        Kind::NoData,
        "no data: nothing but blank and comment lines",
        "",
        Vec::new,
    ),
    Entry::error(Kind::NoRows, "[{found} found, ]no data rows", "", Vec::new),
    Entry::error(Kind::TooManyRows, "more than {limit} rows", "", || {
        vec![Remedy::set(OptionName::MaxRows)]
    }),
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
