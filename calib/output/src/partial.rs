//! The file beside its target that is written first.
//!
//! `.NAME.stillpoint-PROCESS-RANDOM.partial` is created exclusively, so that no link is followed, and
//! locked while its owner lives. What a killed run left is not locked, and the next run in that folder
//! removes it.

use std::fs::{File, Metadata, TryLockError};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use tempfile::NamedTempFile;

use crate::error::{Error as OutputError, Reason};
use crate::leftovers::leftovers;

const MARK: &str = ".stillpoint-";
const ENDING: &str = ".partial";
/// Characters that nobody can foresee.
const RANDOM: usize = 10;
/// Bytes of the target's name that the partial file's keeps; the rest of 255 is for what is added.
const LONGEST_STEM: usize = 160;
/// Longest wait for another run that claims a file in the same folder.
const PATIENCE: Duration = Duration::from_secs(2);

/// A partial file; it disappears unless it is published.
#[derive(Debug)]
pub struct Partial {
    file: Option<NamedTempFile>,
    path: PathBuf,
}

/// Result of moving a partial file to its place.
#[derive(Debug)]
pub enum Published {
    /// It is in its place.
    Yes,
    /// A file that was not to be replaced was in the way.
    Exists,
    /// The system's reason.
    No(Error),
}

impl Partial {
    /// A partial file for `target`, which the user calls `named`.
    ///
    /// # Errors
    /// Another output of this process, a file of another run for it that is locked, or none can be made.
    pub fn create(
        named: &Path,
        target: &Path,
        replaced: Option<&Metadata>,
    ) -> Result<Self, OutputError> {
        let name = target.file_name().map(stem);
        let stem = name.ok_or_else(|| Reason::Nameless.of(named))?;
        let folder = target.parent().filter(|p| !p.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        // Runs that claim in one folder at the same time look one after the other.
        let _turn = turn(folder);
        let mut leftovers = leftovers();
        if let Some(process) = holder(folder, &stem) {
            let is_own = process == own_process().to_string();
            let reason = match is_own {
                true => Reason::Twice,
                false => Reason::Held(process),
            };
            return Err(reason.of(named));
        }
        let prefix = format!(".{stem}{MARK}{}-", own_process());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(ENDING).rand_bytes(RANDOM);
        if replaced.is_none() {
            like_any_other_file(&mut builder);
        }
        let file = builder.tempfile_in(folder);
        let file = file.map_err(|e| Reason::System(e).of(named))?;
        // A file system without locks costs the message about a second run, nothing else.
        let _ = file.as_file().try_lock();
        let path = file.path().to_owned();
        leftovers.files.push(path.clone());
        Ok(Self {
            file: Some(file),
            path,
        })
    }

    /// The file to write to.
    ///
    /// # Errors
    /// None but after it was published.
    pub fn file(&mut self) -> Result<&mut File, Error> {
        let file = self.file.as_mut().map(NamedTempFile::as_file_mut);
        file.ok_or_else(|| ErrorKind::NotFound.into())
    }

    /// Renames it to `target`, over another file only with `force`; it takes the permissions of the one `replaced`.
    pub fn publish(mut self, target: &Path, force: bool, replaced: Option<&Metadata>) -> Published {
        let held = leftovers();
        let Some(file) = self.file.take() else {
            return Published::No(ErrorKind::NotFound.into());
        };
        let prepared = replaced.map_or(Ok(()), |replaced| take_after(replaced, file.as_file()));
        let persisted = match prepared {
            Err(error) => Err(error),
            Ok(()) if force => file.persist(target).map_err(|e| e.error),
            Ok(()) => file.persist_noclobber(target).map_err(|e| e.error),
        };
        drop(held);
        match persisted.map(|_| ()) {
            Ok(()) => Published::Yes,
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Published::Exists,
            Err(error) => Published::No(error),
        }
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        let mut leftovers = leftovers();
        drop(self.file.take());
        leftovers.files.retain(|path| *path != self.path);
    }
}

/// The permissions of a new file, which those of a temporary one are not.
fn like_any_other_file(builder: &mut tempfile::Builder<'_, '_>) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The process's mask takes off what the user wants taken off.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    #[cfg(not(unix))]
    let _ = builder;
}

/// Gives `file` the owner, where that is allowed, and the permissions of the one it replaces.
fn take_after(replaced: &Metadata, file: &File) -> Result<(), Error> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let own = file.metadata()?;
        if (own.uid(), own.gid()) != (replaced.uid(), replaced.gid()) {
            let _ = fchown(file, Some(replaced.uid()), Some(replaced.gid()));
        }
    }
    file.set_permissions(replaced.permissions())
}

/// The target's name as text, shortened; with a mark of the whole name where something is lost.
fn stem(name: &std::ffi::OsStr) -> String {
    let text = name.to_string_lossy();
    let safe: String = text.chars().filter(|c| !c.is_control()).collect();
    if name.to_str() == Some(&safe) && safe.len() <= LONGEST_STEM {
        return safe;
    }
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    let kept = safe.char_indices().map(|(at, c)| at + c.len_utf8());
    let end = kept.take_while(|end| *end <= LONGEST_STEM).last();
    format!("{}~{:016x}", &safe[..end.unwrap_or(0)], hasher.finish())
}

/// The number of this process; 0 where a program is the only one that sees its files, as in WebAssembly.
fn own_process() -> u32 {
    if cfg!(target_family = "wasm") {
        return 0;
    }
    std::process::id()
}

/// A lock on the folder itself; `None` where that cannot be had in time.
fn turn(folder: &Path) -> Option<File> {
    let folder = File::open(folder).ok()?;
    let begin = Instant::now();
    loop {
        match folder.try_lock() {
            Ok(()) => return Some(folder),
            Err(TryLockError::WouldBlock) if begin.elapsed() < PATIENCE => {
                std::thread::sleep(Duration::from_millis(2));
            }
            Err(_) => return None,
        }
    }
}

/// The process that is about to write the file called `stem`. Files of runs that live no more go.
fn holder(folder: &Path, stem: &str) -> Option<String> {
    let mut holder = None;
    for entry in std::fs::read_dir(folder).ok()?.flatten() {
        let name = entry.file_name();
        let Some((of, process)) = name.to_str().and_then(taken_apart) else {
            continue;
        };
        match is_held(&entry.path()) {
            Some(true) if of == stem => holder = Some(process.to_owned()),
            Some(false) => {
                let _ = std::fs::remove_file(entry.path());
            }
            _ => {}
        }
    }
    holder
}

/// The target's name and the process in the name of a partial file.
fn taken_apart(name: &str) -> Option<(&str, &str)> {
    let inner = name.strip_prefix('.')?.strip_suffix(ENDING)?;
    let (stem, owner) = inner.rsplit_once(MARK)?;
    let (process, random) = owner.split_once('-')?;
    let is_ours = random.len() == RANDOM
        && random.bytes().all(|b| b.is_ascii_alphanumeric())
        && !process.is_empty()
        && process.bytes().all(|b| b.is_ascii_digit());
    is_ours.then_some((stem, process))
}

/// Returns true if the partial file at `path` is locked; `None` if this cannot be determined.
fn is_held(path: &Path) -> Option<bool> {
    if !std::fs::symlink_metadata(path).ok()?.is_file() {
        return None;
    }
    match File::open(path).ok()?.try_lock() {
        Ok(()) => Some(false),
        Err(TryLockError::WouldBlock) => Some(true),
        Err(TryLockError::Error(_)) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_that_we_give_are_taken_for_ours() {
        let ours = ".cal.json.stillpoint-4711-a1B2c3D4e5.partial";
        assert_eq!(taken_apart(ours), Some(("cal.json", "4711")));
        for other in [
            ".cal.json.partial",
            "cal.json.stillpoint-4711-a1B2c3D4e5.partial",
            ".cal.json.stillpoint-4711-a1B2.partial",
            ".cal.json.stillpoint-x-a1B2c3D4e5.partial",
            ".cal.json.stillpoint-4711-a1B2c3D4e5",
        ] {
            assert_eq!(taken_apart(other), None, "{other}");
        }
    }

    #[test]
    fn long_and_unprintable_names_have_a_stem_of_their_own() {
        assert_eq!(stem("cal.json".as_ref()), "cal.json");
        let long = |last: char| stem(format!("{}{last}", "ä".repeat(120)).as_ref());
        assert!(long('a').len() < 200);
        assert_ne!(long('a'), long('b'));
        assert!(!stem("a\u{1b}[2J".as_ref()).contains('\u{1b}'));
    }
}
