//! Words of what cannot be opened, or holds nothing.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A file is not there.
    FILE_MISSING = "file_missing" => error(
        "the file cannot be opened: {reason}[, in {folder}][; nearest: {nearest}]",
        "check the name and the folder",
    ),
    /// A link leads to nothing.
    LINK_TO_NOTHING = "link_to_nothing" => error(
        "the file cannot be opened: {reason}[, in {folder}]; it is a link to nothing",
        "name the file itself, or mend the link",
    ),
    /// A file is empty.
    EMPTY_FILE = "empty_file" => error("the file is empty", "copy or export the file again"),
    /// Nothing came on standard input.
    EMPTY_INPUT = "empty_input" => error("standard input is empty", "pipe a recording into it"),
    /// Standard input is a terminal.
    INPUT_IS_TERMINAL = "input_is_terminal" => error(
        "`-` is standard input, and that is a terminal",
        "pipe a recording into it",
    ),
    /// A file is larger than the limit.
    FILE_TOO_LARGE = "file_too_large" => error_by(
        "the file has {size}, more than the limit of {limit}. Its rows (about {rows}) need {memory} of memory",
        vec![Remedy::set(OptionName::MaxBytes)],
    ),
    /// A text goes on beyond the limit.
    TOO_MANY_BYTES = "too_many_bytes" => error_with(
        "the file has more than {limit} bytes[ of {what}], the most that the program reads",
        "cut the recording into parts",
        vec![Remedy::such_as(OptionName::MaxBytes, "40000000000")],
    ),
    /// Several files are where one table was expected.
    SEVERAL_FILES = "several_files" => error(
        "this is {holder}, where one table was expected",
        "name the one file that is meant",
    ),
    /// Something else is where a text was expected.
    NO_TEXT = "no_text" => error(
        "this file is no text, where a table of one sensor was expected",
        "name a text table, such as CSV, for each sensor; a recording of both sensors in one file is named by itself",
    ),
    /// A file is a document of this program.
    OWN_DOCUMENT = "own_document" => error(
        "this is a document of Stillpoint ({what}), where a recording was expected",
        "name a recording here",
    ),
    /// A file is of no known format.
    UNKNOWN_FORMAT = "unknown_format" => error(
        "this file is of no known format",
        "export it as CSV with the header t,ax,ay,az,gx,gy,gz",
    ),
    /// A format does not exist.
    NO_FORMAT = "no_format" => error(
        "there is no format `{format}`; known: {known}",
        "choose one of these",
    ),
    /// A file is not what the chosen format reads.
    OTHER_FORMAT = "other_format" => error_by(
        "the format {format} was asked for, which reads {expected}, and this file is none",
        vec![Remedy::Omit {
            option: OptionName::Format,
        }],
    ),
    /// A file changed while it was read.
    FILE_CHANGED = "file_changed" => error(
        "the file changed while it was read",
        "wait until it is complete, or copy it first",
    ),
    /// A stream that went by would have to be read again.
    READ_TWICE = "read_twice" => error(
        "the sensors of this recording have clocks of their own, so that the program reads it twice, and a stream can be read once only",
        "save it to a file and name that",
    ),
    /// A folder is where a file was expected.
    FOLDER_AS_FILE = "folder_as_file" => error(
        "this is a folder, where a file was expected",
        "name a file in it",
    ),
    /// A small text file is too large to be one.
    TEXT_TOO_LARGE = "text_too_large" => error(
        "the file has more than 64 MiB: this is no calibration, spec or effect file",
        "name another file",
    ),
    /// A text is no UTF-8.
    NOT_UTF8 = "not_utf8" => error(
        "no UTF-8 text is in this line: the file is another one, is damaged, or has another encoding",
        "name the right file if this is another; if it is the right one, copy it again or save it as UTF-8 in a text editor",
    ),
    /// A text holds bytes that no text has.
    BINARY_DATA = "binary_data" => error(
        "the text has binary data at byte {at_byte}, as a damaged file or one of another format has",
        "copy or export the file again",
    ),
    /// A line is too long for a recording.
    LINE_TOO_LONG = "line_too_long" => error(
        "the file has a line of more than 1 MiB: this is no recording in text",
        "name another file",
    ),
    /// A text begins with nothing but comments.
    ONLY_COMMENTS = "only_comments" => error(
        "the file begins with 64 MiB of comments and no row: is this no recording?",
        "delete the comments",
    ),
    /// A text has nothing but blank and comment lines.
    NO_DATA = "no_data" => error(
        "the file has no data: nothing but blank and comment lines",
        "name a file with rows of readings",
    ),
    /// A text has no rows.
    NO_ROWS = "no_rows" => error(
        "[{found} found, ]no data rows",
        "copy or export the file again",
    ),
    /// A text has more rows than the limit.
    TOO_MANY_ROWS = "too_many_rows" => error_with(
        "the recording has more than {limit} rows, the most that the program reads",
        "cut the recording into parts",
        vec![Remedy::such_as(OptionName::MaxRows, "400000000")],
    ),
    /// Rows need more memory than the system grants.
    TOO_LARGE_FOR_MEMORY = "too_large_for_memory" => error(
        "about {rows} rows need {size} of memory, more than the system grants",
        "cut the recording into parts, or raise the limit (ulimit -v)",
    ),
    /// The memory is used up.
    OUT_OF_MEMORY = "out_of_memory" => error(
        "not enough memory for more rows",
        "cut the recording here, or raise the limit (ulimit -v)",
    ),
}
