//! Why a file is not written.

use std::path::{Path, PathBuf};
use std::{fmt, io};

use findings::{Finding, Kind, Remedy};

/// A file that is not written. What had been there is as it was.
#[derive(Debug)]
pub struct Error {
    /// The file or folder, as it was named.
    pub path: PathBuf,
    /// Why.
    pub reason: Reason,
}

/// Why a file is not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum Reason {
    /// It is an input or a member of one.
    Input(PathBuf),
    /// It is claimed already in this process.
    Twice,
    /// It is there and not to be replaced.
    Exists,
    /// It was not there when it was claimed.
    Appeared,
    /// A pipe, a device or a folder.
    NoFile,
    /// Nobody may write to it.
    Protected,
    /// It ends with a slash.
    NamesFolder,
    /// It has no last part.
    Nameless,
    /// A link whose aim is not there.
    Dangling(PathBuf),
    /// A link where a folder of our own is expected.
    Linked,
    /// Another process has claimed it.
    Held(String),
    /// A folder cannot be made.
    Folder(io::Error),
    /// The system refuses.
    System(io::Error),
}

impl Error {
    /// The finding, with the file as its place.
    pub fn finding(&self) -> Finding {
        self.reason.finding().in_file(shown(&self.path))
    }
}

impl Reason {
    pub(crate) fn of(self, path: &Path) -> Error {
        Error {
            path: path.to_owned(),
            reason: self,
        }
    }

    /// The finding without its place.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Input(input) => Finding::of(Kind::OUTPUT_IS_INPUT).detail("input", shown(input)),
            Self::Twice => Finding::of(Kind::OUTPUT_TWICE),
            Self::Exists => Finding::of(Kind::OUTPUT_EXISTS),
            Self::Appeared => Finding::of(Kind::OUTPUT_APPEARED),
            Self::NoFile => Finding::of(Kind::OUTPUT_NO_FILE),
            Self::Protected => Finding::of(Kind::OUTPUT_PROTECTED),
            Self::NamesFolder => Finding::of(Kind::OUTPUT_IS_FOLDER),
            Self::Nameless => Finding::of(Kind::OUTPUT_NAMELESS),
            Self::Dangling(aim) => Finding::of(Kind::OUTPUT_DANGLING).detail("aim", shown(aim)),
            Self::Linked => Finding::of(Kind::OUTPUT_LINKED),
            Self::Held(process) => Finding::of(Kind::OUTPUT_HELD).detail("process", process),
            Self::Folder(error) => Finding::of_system(Kind::FOLDER_REFUSED, error),
            Self::System(error) => Finding::of_system(Kind::UNWRITABLE, error)
                .remedy(Remedy::for_writing(error.kind())),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.reason {
            Reason::Folder(error) | Reason::System(error) => Some(error),
            _ => None,
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

/// A path in one line.
fn shown(path: &Path) -> String {
    path.to_string_lossy().escape_debug().to_string()
}
