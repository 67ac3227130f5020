//! Words of errors: zip archives.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ZipDirectoryDamaged,
        "the zip archive is damaged: entry {index} of its list of files (its directory) cannot be read",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipDirectoryMissing,
        "the zip archive ends without its list of files (its directory): it was cut short",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipEncrypted,
        "the archive's file `{entry}` is encrypted, and the program cannot decrypt it",
        "unpack the archive with its password and name the folder",
        Vec::new,
    ),
    Entry::error(
        Kind::ZipEntryBeyond,
        "the zip archive is cut short or damaged: its file `{entry}` reaches beyond the end of the archive",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipEntriesOverlap,
        "the zip archive is damaged or forged: its files `{entry}` and `{other}` overlap, as in no honest archive",
        "pack the files again, or unpack them yourself if you trust the archive",
        Vec::new,
    ),
    Entry::error(
        Kind::ZipEntryMissing,
        "the zip archive is damaged: its list of files names a file at this byte, and no zip entry is here",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipMethodUnknown,
        "a file in the zip archive is packed by method {method}, and the program reads only `stored` and `deflate`",
        "unpack the archive and name the folder",
        Vec::new,
    ),
    Entry::error(
        Kind::ZipEntryCut,
        "a file in the zip archive is cut short: {missing:byte} are missing",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::EntryElsewhere,
        "the file `{entry}` is not in the archive that was opened",
        "name the archive that holds it, or unpack it first",
        Vec::new,
    ),
];
