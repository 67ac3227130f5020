//! Why a file is not written.

use std::io;
use std::path::{Path, PathBuf};

/// A file that is not written. What had been there is as it was.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {reason}", path = path.display())]
pub struct Error {
    /// The file or folder, as it was named.
    pub path: PathBuf,
    /// Why, and what to do.
    pub reason: Reason,
}

/// Why a file is not written, and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Reason {
    /// It is an input or a member of one.
    #[error("is the input {input} or a file of it; choose another name", input = shown(.0))]
    Input(PathBuf),
    /// It is claimed already in this process.
    #[error("given for two outputs; choose another name")]
    Twice,
    /// It is there and not to be replaced.
    #[error("exists already")]
    Exists,
    /// It was not there when it was claimed.
    #[error("was written by something else meanwhile and is left as it is")]
    Appeared,
    /// A pipe, a device or a folder.
    #[error("is no regular file; choose another name")]
    NoFile,
    /// Nobody may write to it.
    #[error("is write-protected; choose another name, or allow writing to it")]
    Protected,
    /// It ends with a slash.
    #[error("names a folder; name a file to write")]
    NamesFolder,
    /// It has no last part.
    #[error("is no file name; name a file to write")]
    Nameless,
    /// A link whose aim is not there.
    #[error("is a link to nothing ({aim}); remove the link or choose another name", aim = shown(.0))]
    Dangling(PathBuf),
    /// A link where a folder of our own is expected.
    #[error("is a link where a folder is expected; remove the link")]
    Linked,
    /// Another process has claimed it.
    #[error("is being written by another run (process {0}); wait for it")]
    Held(String),
    /// A folder cannot be made.
    #[error("cannot be made: {0}; choose a folder that can be written to")]
    Folder(io::Error),
    /// The system refuses.
    #[error("cannot be written: {0}; {advice}", advice = advice(.0))]
    System(io::Error),
}

impl Reason {
    pub(crate) fn of(self, path: &Path) -> Error {
        Error {
            path: path.to_owned(),
            reason: self,
        }
    }
}

impl From<Error> for io::Error {
    /// For callers whose own errors hold the path.
    fn from(error: Error) -> Self {
        match error.reason {
            Reason::System(source) | Reason::Folder(source) => source,
            reason @ (Reason::Exists | Reason::Appeared) => {
                Self::new(io::ErrorKind::AlreadyExists, reason.to_string())
            }
            reason => Self::new(io::ErrorKind::InvalidInput, reason.to_string()),
        }
    }
}

/// What can be done about the system's reason.
fn advice(error: &io::Error) -> &'static str {
    use io::ErrorKind as E;
    match error.kind() {
        E::StorageFull | E::QuotaExceeded => "make room, or write to another disk",
        E::FileTooLarge => "raise the limit on file sizes (ulimit -f)",
        E::NotFound => "make the folder first",
        E::PermissionDenied | E::ReadOnlyFilesystem => "choose a folder that can be written to",
        // Network file systems fail now and then, and some cannot rename over a file.
        _ => "try again, or choose a folder on another file system",
    }
}

/// A path in one line.
fn shown(path: &Path) -> String {
    path.to_string_lossy().escape_debug().to_string()
}
