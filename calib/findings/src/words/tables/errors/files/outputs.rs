//! Words of errors: files that are written.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::OutputIsInput,
        "is the input {input} or a file of it",
        "",
        || vec![Remedy::OtherName],
    ),
    Entry::error(Kind::OutputTwice, "given for two outputs", "", || {
        vec![Remedy::OtherName]
    }),
    Entry::error(Kind::OutputExists, "exists already", "", || {
        vec![Remedy::Replace, Remedy::KeepExisting]
    }),
    Entry::error(
        Kind::OutputAppeared,
        "was written by something else meanwhile and is left as it is",
        "",
        || vec![Remedy::Replace],
    ),
    Entry::error(Kind::OutputNoFile, "is no regular file", "", || {
        vec![Remedy::OtherName]
    }),
    Entry::error(
        Kind::OutputProtected,
        "is write-protected",
        "choose another name, or allow writing to it",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputIsFolder,
        "names a folder",
        "name a file to write",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputNameless,
        "is no file name",
        "name a file to write",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputDangling,
        "is a link to nothing ({aim})",
        "remove the link or choose another name",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputLinked,
        "is a link where a folder is expected",
        "remove the link",
        Vec::new,
    ),
    Entry::error(
        Kind::OutputHeld,
        "is being written by another run (process {process})",
        "wait for it",
        Vec::new,
    ),
    Entry::error(Kind::FolderRefused, "cannot be made: {reason}", "", || {
        vec![Remedy::OtherFolder]
    }),
];
