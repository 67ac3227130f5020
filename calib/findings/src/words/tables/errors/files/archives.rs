//! Words of errors: zip archives.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ZipDirectoryDamaged => error_by(
            "the zip archive is damaged: entry {index} of its list of files (its directory) cannot be read",
            vec![Remedy::CopyAgain],
        ),
        Kind::ZipDirectoryMissing => error_by(
            "the zip archive ends without its list of files (its directory): it was cut short",
            vec![Remedy::CopyAgain],
        ),
        Kind::ZipEncrypted => error(
            "the archive's file `{entry}` is encrypted, and the program cannot decrypt it",
            "unpack the archive with its password and name the folder",
        ),
        Kind::ZipEntryBeyond => error_by(
            "the zip archive is cut short or damaged: its file `{entry}` reaches beyond the end of the archive",
            vec![Remedy::CopyAgain],
        ),
        Kind::ZipEntriesOverlap => error(
            "the zip archive is damaged or forged: its files `{entry}` and `{other}` overlap, as in no honest archive",
            "pack the files again, or unpack them yourself if you trust the archive",
        ),
        Kind::ZipEntryMissing => error_by(
            "the zip archive is damaged: its list of files names a file at this byte, and no zip entry is here",
            vec![Remedy::CopyAgain],
        ),
        Kind::ZipMethodUnknown => error(
            "a file in the zip archive is packed by method {method}, and the program reads only `stored` and `deflate`",
            "unpack the archive and name the folder",
        ),
        Kind::ZipEntryCut => error_by(
            "a file in the zip archive is cut short: {missing:byte} are missing",
            vec![Remedy::CopyAgain],
        ),
        Kind::EntryElsewhere => error(
            "the file `{entry}` is not in the archive that was opened",
            "name the archive that holds it, or unpack it first",
        ),
        _ => return None,
    })
}
