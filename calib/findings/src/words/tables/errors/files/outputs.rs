//! Words of errors: files that are written.

use crate::remedy::Remedy;
use crate::words::entry::{error, error_by};

kinds! {
    /// An output is an input or a file of one.
    OUTPUT_IS_INPUT = "output_is_input" => error_by(
        "the output is the input {input} or a file of it, and would overwrite it",
        vec![Remedy::OtherName],
    ),
    /// A name is given for two outputs.
    OUTPUT_TWICE = "output_twice" => error_by(
        "the same file is given for two outputs",
        vec![Remedy::OtherName],
    ),
    /// An output is there already.
    OUTPUT_EXISTS = "output_exists" => error_by(
        "the output exists already",
        vec![Remedy::Replace, Remedy::KeepExisting],
    ),
    /// An output was written by something else meanwhile.
    OUTPUT_APPEARED = "output_appeared" => error_by(
        "the output was written by something else meanwhile, and the program left it as it is",
        vec![Remedy::Replace],
    ),
    /// An output is a pipe, a device or a folder.
    OUTPUT_NO_FILE = "output_no_file" => error_by("the output is no regular file", vec![Remedy::OtherName]),
    /// An output is write-protected.
    OUTPUT_PROTECTED = "output_protected" => error(
        "the output is write-protected",
        "choose another name, or allow writing to it",
    ),
    /// The name of an output is that of a folder.
    OUTPUT_IS_FOLDER = "output_is_folder" => error("the output names a folder", "name a file to write"),
    /// The name of an output has no last part.
    OUTPUT_NAMELESS = "output_nameless" => error("the output is no file name", "name a file to write"),
    /// An output is a link to nothing.
    OUTPUT_DANGLING = "output_dangling" => error(
        "the output is a link to nothing ({aim})",
        "remove the link or choose another name",
    ),
    /// A link stands where a folder is expected.
    OUTPUT_LINKED = "output_linked" => error(
        "the output is a link where a folder is expected",
        "remove the link",
    ),
    /// Another run writes an output.
    OUTPUT_HELD = "output_held" => error(
        "the output is being written by another run (process {process})",
        "wait until that run has ended",
    ),
    /// A folder cannot be made.
    FOLDER_REFUSED = "folder_refused" => error_by(
        "the folder cannot be made: {reason}",
        vec![Remedy::OtherFolder],
    ),
}
