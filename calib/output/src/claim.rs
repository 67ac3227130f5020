//! A claim on a file, and what becomes of it.

use std::fs::Metadata;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::error::{Error, Reason};
use crate::identity;
use crate::partial::{Partial, Published};

/// Treatment of a file that already exists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Existing {
    /// It stays, and the output is refused.
    #[default]
    Refuse,
    /// It is replaced once the new one is complete.
    Replace,
    /// It stays, and nothing is written.
    Keep,
}

/// A claim on a file to be written.
#[derive(Debug)]
pub struct Output(Option<Claim>);

#[derive(Debug)]
struct Claim {
    /// Path as given by the caller.
    named: PathBuf,
    target: PathBuf,
    existing: Existing,
    /// The file that is there and will be replaced.
    replaced: Option<Metadata>,
    partial: Partial,
    /// True if the data are synced to disk before the file moves to its place.
    synced: bool,
}

/// An output that is complete but not in its place yet.
#[derive(Debug)]
pub struct Filled(Option<Claim>);

impl Output {
    /// Claims the file that a person calls `path`, through links; `inputs` are files and folders of recordings that it must
    /// not be or lie in.
    ///
    /// # Errors
    /// An input, a file in the way, what is no regular file, another claim on it, a folder that cannot be written.
    pub fn claim(path: &Path, existing: Existing, inputs: &[&Path]) -> Result<Self, Error> {
        let target = refuse_input(path, inputs)?;
        let replaced = in_the_way(path, &target)?;
        Self::at(path, target, replaced, existing)
    }

    /// Claims a file that we name ourselves, in `folder`: a link that is in its place is replaced, never followed.
    ///
    /// # Errors
    /// As [`claim`](Self::claim).
    pub fn claim_in(
        folder: &Path,
        name: &str,
        existing: Existing,
        inputs: &[&Path],
    ) -> Result<Self, Error> {
        let path = folder.join(name);
        refuse_input(&path, inputs)?;
        let replaced = match path.is_symlink() {
            true => None,
            false => in_the_way(&path, &path)?,
        };
        Self::at(&path, path.clone(), replaced, existing)
    }

    /// Claims `target`, with the file that stands there.
    fn at(
        path: &Path,
        target: PathBuf,
        replaced: Option<Metadata>,
        existing: Existing,
    ) -> Result<Self, Error> {
        match (replaced.is_some() || target.is_symlink(), existing) {
            (true, Existing::Keep) => return Ok(Self(None)),
            (true, Existing::Refuse) => return Err(Reason::Exists.of(path)),
            _ => {}
        }
        let partial = Partial::create(path, &target, replaced.as_ref())?;
        Ok(Self(Some(Claim {
            named: path.to_owned(),
            target,
            existing,
            replaced,
            partial,
            synced: true,
        })))
    }

    /// Returns true if an existing file is kept, so that nothing will be written.
    pub fn is_kept(&self) -> bool {
        self.0.is_none()
    }

    /// Leaves it to the system when the file is on the disk: after a power failure it may be short. For files of which something
    /// else knows the hash.
    #[must_use]
    pub fn unsynced(mut self) -> Self {
        if let Some(claim) = &mut self.0 {
            claim.synced = false;
        }
        self
    }

    /// Puts `contents` in place of the target.
    ///
    /// # Errors
    /// The system's reason; the target is as it was.
    pub fn write(self, contents: &[u8]) -> Result<(), Error> {
        self.fill(|out| out.write_all(contents))?.publish()
    }

    /// Writes what `fill` gives and syncs it; the target is as it was until [`Filled::publish`].
    ///
    /// # Errors
    /// The system's reason; the target is as it was.
    pub fn fill(
        self,
        fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<Filled, Error> {
        let Some(mut claim) = self.0 else {
            return Ok(Filled(None));
        };
        let synced = claim.synced;
        let written = claim.partial.file().and_then(|file| {
            let mut out = BufWriter::new(file);
            fill(&mut out)?;
            out.flush()?;
            match synced {
                true => out.get_ref().sync_all(),
                false => Ok(()),
            }
        });
        match written {
            Ok(()) => Ok(Filled(Some(claim))),
            Err(error) => Err(Reason::System(error).of(&claim.named)),
        }
    }
}

impl Filled {
    /// Renames the complete file to its target.
    ///
    /// # Errors
    /// The system's reason, or a file that has come into the way; that is as it was.
    pub fn publish(self) -> Result<(), Error> {
        let Some(claim) = self.0 else { return Ok(()) };
        let replace = claim.existing == Existing::Replace;
        match claim
            .partial
            .publish(&claim.target, replace, claim.replaced.as_ref())
        {
            Published::Yes => {
                // The name is on the disk as well, where the folder can be synced.
                let folder = claim.target.parent().filter(|_| claim.synced);
                if let Some(folder) = folder.and_then(|path| std::fs::File::open(path).ok()) {
                    let _ = folder.sync_all();
                }
                Ok(())
            }
            Published::Exists => Err(Reason::Appeared.of(&claim.named)),
            Published::No(error) => Err(Reason::System(error).of(&claim.named)),
        }
    }
}

/// The file that `path` leads to, which is none of `inputs` and no file of them.
///
/// # Errors
/// An input.
pub fn refuse_input(path: &Path, inputs: &[&Path]) -> Result<PathBuf, Error> {
    let target = identity::resolve(path);
    match identity::input_at(&target, inputs) {
        Some(input) => Err(Reason::Input(input.to_owned()).of(path)),
        None => Ok(target),
    }
}

/// The regular file that stands where the output is to go.
fn in_the_way(path: &Path, target: &Path) -> Result<Option<Metadata>, Error> {
    let named_as_folder = path.as_os_str().as_encoded_bytes().ends_with(b"/");
    match std::fs::metadata(target) {
        Ok(found) if !found.is_file() => Err(Reason::NoFile.of(path)),
        Ok(found) if found.permissions().readonly() => Err(Reason::Protected.of(path)),
        Ok(found) => Ok(Some(found)),
        Err(_) if named_as_folder => Err(Reason::NamesFolder.of(path)),
        Err(_) if target.is_symlink() => {
            let aim = std::fs::read_link(target).unwrap_or_default();
            Err(Reason::Dangling(aim).of(path))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        // Of a file that is there the permissions would be lost.
        Err(error) => Err(Reason::System(error).of(path)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_new_or_as_it_was_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        Output::claim(&path, Existing::Refuse, &[])
            .unwrap()
            .write(b"old")
            .unwrap();
        let refused = Output::claim(&path, Existing::Refuse, &[]).unwrap_err();
        assert!(matches!(refused.reason, Reason::Exists));
        assert!(Output::claim(&path, Existing::Keep, &[]).unwrap().is_kept());
        let failing = Output::claim(&path, Existing::Replace, &[]).unwrap();
        let failed = failing.fill(|out| {
            out.write_all(b"half")?;
            Err(std::io::ErrorKind::StorageFull.into())
        });
        assert!(failed.unwrap_err().to_string().contains("make room"));
        let claimed = Output::claim(&path, Existing::Replace, &[]).unwrap();
        let twice = Output::claim(&path, Existing::Replace, &[]).unwrap_err();
        assert!(matches!(twice.reason, Reason::Twice));
        drop(claimed);
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_in_place_of_a_file_that_we_name_is_replaced_and_its_aim_is_no_victim() {
        let folder = tempfile::tempdir().unwrap();
        let (victim, link) = (folder.path().join("victim"), folder.path().join("link"));
        std::fs::write(&victim, "precious").unwrap();
        std::os::unix::fs::symlink(&victim, &link).unwrap();
        let claim = |existing| Output::claim_in(folder.path(), "link", existing, &[]);
        assert!(claim(Existing::Refuse).is_err());
        claim(Existing::Replace).unwrap().write(b"new").unwrap();
        assert_eq!(std::fs::read(&victim).unwrap(), b"precious");
        assert!(!link.is_symlink() && std::fs::read(&link).unwrap() == b"new");
        // What a person names is written through links.
        std::fs::remove_file(&link).unwrap();
        std::os::unix::fs::symlink(&victim, &link).unwrap();
        let named = Output::claim(&link, Existing::Replace, &[]).unwrap();
        named.write(b"new").unwrap();
        assert_eq!(std::fs::read(&victim).unwrap(), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_a_person_names_and_that_leads_to_no_file_stays() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().canonicalize().unwrap();
        let link = inside.join("link");
        let (socket, gone) = (inside.join("socket"), inside.join("gone"));
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        for aim in [&socket, &gone] {
            std::os::unix::fs::symlink(aim, &link).unwrap();
            for existing in [Existing::Refuse, Existing::Replace] {
                let refused = Output::claim(&link, existing, &[]).unwrap_err();
                let is_said = matches!(refused.reason, Reason::NoFile | Reason::Dangling(_));
                assert!(is_said, "{refused}");
            }
            assert!(link.is_symlink());
            std::fs::remove_file(&link).unwrap();
        }
    }
}
