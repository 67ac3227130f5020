//! Words of errors: files that are written.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::OutputIsInput,
        "the output is the input {input} or a file of it, and would overwrite it",
        "",
        || vec![Remedy::OtherName],
    ),
    Entry::error(
        Kind::OutputTwice,
        "the same file is given for two outputs",
        "",
        || vec![Remedy::OtherName],
    ),
    Entry::error(Kind::OutputExists, "the output exists already", "", || {
        vec![Remedy::Replace, Remedy::KeepExisting]
    }),
    Entry::error(
        Kind::OutputAppeared,
        "the output was written by something else meanwhile, and the program left it as it is",
        "",
        || vec![Remedy::Replace],
    ),
    Entry::error(
        Kind::OutputNoFile,
        "the output is no regular file",
        "",
        || vec![Remedy::OtherName],
    ),
    Entry::error(
        Kind::OutputProtected,
        "the output is write-protected",
        "choose another name, or allow writing to it",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputIsFolder,
        "the output names a folder",
        "name a file to write",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputNameless,
        "the output is no file name",
        "name a file to write",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputDangling,
        "the output is a link to nothing ({aim})",
        "remove the link or choose another name",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputLinked,
        "the output is a link where a folder is expected",
        "remove the link",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputHeld,
        "the output is being written by another run (process {process})",
        "wait until that run has ended",
        Vec::new,
    ),
    Entry::error(
        Kind::FolderRefused,
        "the folder cannot be made: {reason}",
        "",
        || vec![Remedy::OtherFolder],
    ),
];
