//! Words of errors: zip archives.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ZipDirectoryDamaged,
        "entry {index} of the zip archive's directory is damaged",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipDirectoryMissing,
        "the zip archive ends without its directory: it was cut short",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipEncrypted,
        "entry `{entry}` is encrypted",
        "unpack the archive with its password and name the folder",
        Vec::new,
    ),
    Entry::error(
        Kind::ZipEntryBeyond,
        "entry `{entry}` reaches beyond the archive",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::ZipEntriesOverlap,
        "entries `{entry}` and `{other}` overlap, as in no honest archive",
        "",
        Vec::new,
    ),
    Entry::error(Kind::ZipEntryMissing, "no zip entry is here", "", || {
        vec![Remedy::CopyAgain]
    }),
    Entry::error(
        Kind::ZipMethodUnknown,
        "an entry is packed by method {method}, and only `stored` and `deflate` are read",
        "unpack the archive and name the folder",
        Vec::new,
    ),
    Entry::error(
        Kind::ZipEntryCut,
        "the zip entry is cut short: {missing:byte} are missing",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::EntryElsewhere,
        "the entry `{entry}` is of another archive",
        "",
        Vec::new,
    ),
];
