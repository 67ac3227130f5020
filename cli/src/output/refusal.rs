//! Why an output is not written.

use std::io::ErrorKind;
use std::path::Path;

use crate::exit::{Failure, OUTPUT};
use crate::show;

pub(super) fn refused(path: &Path, why: &str) -> Failure {
    Failure::new(OUTPUT, format!("{}: {why}", show::path(path)))
}

/// The system's reason, and what can be done about it.
pub(super) fn not_written(path: &Path, error: &std::io::Error) -> Failure {
    let advice = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "make room, or write to another disk",
        ErrorKind::FileTooLarge => "raise the limit on file sizes (ulimit -f)",
        ErrorKind::NotFound => "make the folder first",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "choose a folder that can be written to"
        }
        // Network file systems fail now and then, and some cannot rename over a file.
        _ => "try again, or choose a folder on another file system",
    };
    let why = format!("cannot be written: {error}; {advice}");
    Failure::new(OUTPUT, format!("{}: {why}", show::path(path)))
}
