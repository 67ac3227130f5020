//! Words of what cannot be opened, or holds nothing.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::FileMissing => error(
            "the file cannot be opened: {reason}[, in {folder}][; nearest: {nearest}]",
            "check the name and the folder",
        ),
        Kind::LinkToNothing => error(
            "the file cannot be opened: {reason}[, in {folder}]; it is a link to nothing",
            "name the file itself, or mend the link",
        ),
        Kind::EmptyFile => error("the file is empty", "copy or export the file again"),
        Kind::EmptyInput => error("standard input is empty", "pipe a recording into it"),
        Kind::InputIsTerminal => error(
            "`-` is standard input, and that is a terminal",
            "pipe a recording into it",
        ),
        Kind::FileTooLarge => error_by(
            "the file has {size}, more than the limit of {limit}. Its rows (about {rows}) need {memory} of memory",
            vec![Remedy::set(OptionName::MaxBytes)],
        ),
        Kind::TooManyBytes => error_with(
            "the file has more than {limit} bytes[ of {what}], the most that the program reads",
            "cut the recording into parts",
            vec![Remedy::such_as(OptionName::MaxBytes, "40000000000")],
        ),
        Kind::SeveralFiles => error(
            "this is {holder}, where one table was expected",
            "name the one file that is meant",
        ),
        Kind::NoText => error(
            "this file is no text, where a table of one sensor was expected",
            "name a text table, such as CSV, for each sensor; a recording of both sensors in one file is named by itself",
        ),
        Kind::OwnDocument => error(
            "this is a document of Stillpoint ({what}), where a recording was expected",
            "name a recording here",
        ),
        Kind::UnknownFormat => error(
            "this file is of no known format",
            "export it as CSV with the header t,ax,ay,az,gx,gy,gz",
        ),
        Kind::NoFormat => error(
            "there is no format `{format}`; known: {known}",
            "choose one of these",
        ),
        Kind::OtherFormat => error_by(
            "the format {format} was asked for, which reads {expected}, and this file is none",
            vec![Remedy::Omit {
                option: OptionName::Format,
            }],
        ),
        Kind::FileChanged => error(
            "the file changed while it was read",
            "wait until it is complete, or copy it first",
        ),
        Kind::ReadTwice => error(
            "the sensors of this recording have clocks of their own, so that the program reads it twice, and a stream can be read once only",
            "save it to a file and name that",
        ),
        Kind::FolderAsFile => error(
            "this is a folder, where a file was expected",
            "name a file in it",
        ),
        Kind::TextTooLarge => error(
            "the file has more than 64 MiB: this is no calibration, spec or effect file",
            "name another file",
        ),
        Kind::NotUtf8 => error(
            "no UTF-8 text is in this line: the file is another one, is damaged, or has another encoding",
            "name the right file if this is another; if it is the right one, copy it again or save it as UTF-8 in a text editor",
        ),
        Kind::BinaryData => error(
            "the text has binary data at byte {at_byte}, as a damaged file or one of another format has",
            "copy or export the file again",
        ),
        Kind::LineTooLong => error(
            "the file has a line of more than 1 MiB: this is no recording in text",
            "name another file",
        ),
        Kind::OnlyComments => error(
            "the file begins with 64 MiB of comments and no row: is this no recording?",
            "delete the comments",
        ),
        Kind::NoData => error(
            "the file has no data: nothing but blank and comment lines",
            "name a file with rows of readings",
        ),
        Kind::NoRows => error(
            "[{found} found, ]no data rows",
            "copy or export the file again",
        ),
        Kind::TooManyRows => error_with(
            "the recording has more than {limit} rows, the most that the program reads",
            "cut the recording into parts",
            vec![Remedy::such_as(OptionName::MaxRows, "400000000")],
        ),
        Kind::TooLargeForMemory => error(
            "about {rows} rows need {size} of memory, more than the system grants",
            "cut the recording into parts, or raise the limit (ulimit -v)",
        ),
        Kind::OutOfMemory => error(
            "not enough memory for more rows",
            "cut the recording here, or raise the limit (ulimit -v)",
        ),
        _ => return None,
    })
}
