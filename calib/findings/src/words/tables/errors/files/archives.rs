//! Words of errors: zip archives.

use crate::remedy::Remedy;
use crate::words::entry::{error, error_by};

kinds! {
    /// The directory of a zip archive is damaged.
    ZIP_DIRECTORY_DAMAGED = "zip_directory_damaged" => error_by(
        "the zip archive is damaged: entry {index} of its list of files (its directory) cannot be read",
        vec![Remedy::CopyAgain],
    ),
    /// A zip archive ends without its directory.
    ZIP_DIRECTORY_MISSING = "zip_directory_missing" => error_by(
        "the zip archive ends without its list of files (its directory): it was cut short",
        vec![Remedy::CopyAgain],
    ),
    /// An entry of a zip archive is encrypted.
    ZIP_ENCRYPTED = "zip_encrypted" => error(
        "the archive's file `{entry}` is encrypted, and the program cannot decrypt it",
        "unpack the archive with its password and name the folder",
    ),
    /// An entry of a zip archive reaches beyond its end.
    ZIP_ENTRY_BEYOND = "zip_entry_beyond" => error_by(
        "the zip archive is cut short or damaged: its file `{entry}` reaches beyond the end of the archive",
        vec![Remedy::CopyAgain],
    ),
    /// Entries of a zip archive overlap.
    ZIP_ENTRIES_OVERLAP = "zip_entries_overlap" => error(
        "the zip archive is damaged or forged: its files `{entry}` and `{other}` overlap, as in no honest archive",
        "pack the files again, or unpack them yourself if you trust the archive",
    ),
    /// A zip archive has no entry at the place that its directory names.
    ZIP_ENTRY_MISSING = "zip_entry_missing" => error_by(
        "the zip archive is damaged: its list of files names a file at this byte, and no zip entry is here",
        vec![Remedy::CopyAgain],
    ),
    /// An entry of a zip archive is packed in a way that is not read.
    ZIP_METHOD_UNKNOWN = "zip_method_unknown" => error(
        "a file in the zip archive is packed by method {method}, and the program reads only `stored` and `deflate`",
        "unpack the archive and name the folder",
    ),
    /// An entry of a zip archive is cut short.
    ZIP_ENTRY_CUT = "zip_entry_cut" => error_by(
        "a file in the zip archive is cut short: {missing:byte} are missing",
        vec![Remedy::CopyAgain],
    ),
    /// An entry is not of the archive that is asked for it.
    ENTRY_ELSEWHERE = "entry_elsewhere" => error(
        "the file `{entry}` is not in the archive that was opened",
        "name the archive that holds it, or unpack it first",
    ),
}
