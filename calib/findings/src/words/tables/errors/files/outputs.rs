//! Words of errors: files that are written.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::OutputIsInput => error_by(
            "the output is the input {input} or a file of it, and would overwrite it",
            vec![Remedy::OtherName],
        ),
        Kind::OutputTwice => error_by(
            "the same file is given for two outputs",
            vec![Remedy::OtherName],
        ),
        Kind::OutputExists => error_by(
            "the output exists already",
            vec![Remedy::Replace, Remedy::KeepExisting],
        ),
        Kind::OutputAppeared => error_by(
            "the output was written by something else meanwhile, and the program left it as it is",
            vec![Remedy::Replace],
        ),
        Kind::OutputNoFile => error_by("the output is no regular file", vec![Remedy::OtherName]),
        Kind::OutputProtected => error(
            "the output is write-protected",
            "choose another name, or allow writing to it",
        ),
        Kind::OutputIsFolder => error("the output names a folder", "name a file to write"),
        Kind::OutputNameless => error("the output is no file name", "name a file to write"),
        Kind::OutputDangling => error(
            "the output is a link to nothing ({aim})",
            "remove the link or choose another name",
        ),
        Kind::OutputLinked => error(
            "the output is a link where a folder is expected",
            "remove the link",
        ),
        Kind::OutputHeld => error(
            "the output is being written by another run (process {process})",
            "wait until that run has ended",
        ),
        Kind::FolderRefused => error_by(
            "the folder cannot be made: {reason}",
            vec![Remedy::OtherFolder],
        ),
        _ => return None,
    })
}
