//! Result files of commands, see the crate `stillpoint-output`: claimed before anything is computed, written whole or not at all.

use std::io::Write;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use output::Existing;
pub use output::{Folder, Growing, is_same_file};

use crate::exit::Failure;

/// The choice where an output exists.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct Replace {
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// Keep existing files; where all of them exist there is nothing to do, and the exit status is 0
    #[arg(long, conflicts_with = "force")]
    skip_existing: bool,
}

/// Outputs claimed in this run, and outputs kept by `--skip-existing`.
static CLAIMED: AtomicUsize = AtomicUsize::new(0);
static KEPT: AtomicUsize = AtomicUsize::new(0);

impl Replace {
    /// Replace what is there.
    pub fn forced() -> Self {
        Self {
            force: true,
            skip_existing: false,
        }
    }

    /// Returns true if existing files are replaced.
    pub fn force(self) -> bool {
        self.force
    }

    /// Returns true if existing files are kept.
    pub fn skip_existing(self) -> bool {
        self.skip_existing
    }

    fn existing(self) -> Existing {
        match (self.force, self.skip_existing) {
            (true, _) => Existing::Replace,
            (false, true) => Existing::Keep,
            (false, false) => Existing::Refuse,
        }
    }

    /// Ends the command where every output exists and is kept. To be called when all are claimed.
    ///
    /// # Errors
    /// Status 0, for there is nothing to do.
    pub fn end_if_all_exist(self) -> Result<(), Failure> {
        match (
            KEPT.load(Ordering::Relaxed),
            CLAIMED.load(Ordering::Relaxed),
        ) {
            (1.., 0) if self.skip_existing => Err(Failure::nothing_to_do(
                "every output exists already: nothing to do (--skip-existing)",
            )),
            _ => Ok(()),
        }
    }
}

/// A claim on a file to be written.
#[derive(Debug)]
pub struct Output(output::Output);

/// An output that is complete but not in its place yet.
#[derive(Debug)]
pub struct Filled(output::Filled);

impl Output {
    /// Claims the file that the call names; `inputs` are files and folders of recordings that it must not be or lie in.
    ///
    /// # Errors
    /// Status 2 where the path is an input or another output of this run; status 6 where it exists (without `--force`), is no
    /// regular file, lies in a folder that cannot be written, or is claimed by another run.
    pub fn claim(path: &Path, replace: Replace, inputs: &[&Path]) -> Result<Self, Failure> {
        Self::counted(output::Output::claim(path, replace.existing(), inputs)?)
    }

    /// Claims the file that the call names, if it names one.
    ///
    /// # Errors
    /// As [`claim`](Self::claim).
    pub fn claim_given(
        path: Option<&Path>,
        replace: Replace,
        inputs: &[&Path],
    ) -> Result<Option<Self>, Failure> {
        let claim = |path| Self::claim(path, replace, inputs);
        path.map(claim).transpose()
    }

    /// Claims a file that the program names, in a folder of the call.
    ///
    /// # Errors
    /// As [`claim`](Self::claim).
    pub fn claim_in(
        folder: &Path,
        name: &str,
        replace: Replace,
        inputs: &[&Path],
    ) -> Result<Self, Failure> {
        let existing = replace.existing();
        Self::counted(output::Output::claim_in(folder, name, existing, inputs)?)
    }

    fn counted(claim: output::Output) -> Result<Self, Failure> {
        let count = if claim.is_kept() { &KEPT } else { &CLAIMED };
        count.fetch_add(1, Ordering::Relaxed);
        Ok(Self(claim))
    }

    /// Puts `contents` in place of the target.
    ///
    /// # Errors
    /// Status 6 with the system's reason; the target is as it was.
    pub fn write(self, contents: &[u8]) -> Result<(), Failure> {
        Ok(self.0.write(contents)?)
    }

    /// Writes a document where a file for it was claimed.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn write_given(claimed: Option<Self>, document: &str) -> Result<(), Failure> {
        claimed.map_or(Ok(()), |output| output.write(document.as_bytes()))
    }

    /// Writes several files; none is put in place before all of them are on the disk.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub fn write_all<T: AsRef<[u8]>>(
        files: impl IntoIterator<Item = (Self, T)>,
    ) -> Result<(), Failure> {
        let fill =
            |(output, contents): (Self, T)| output.fill(|out| out.write_all(contents.as_ref()));
        let filled: Vec<Filled> = files.into_iter().map(fill).collect::<Result<_, _>>()?;
        filled.into_iter().try_for_each(Filled::publish)
    }

    /// Writes what `fill` gives and syncs it; the target is as it was until [`Filled::publish`].
    ///
    /// # Errors
    /// Status 6 with the system's reason; the target is as it was.
    pub fn fill(
        self,
        fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<Filled, Failure> {
        Ok(Filled(self.0.fill(fill)?))
    }
}

impl Filled {
    /// Renames the complete file to its target.
    ///
    /// # Errors
    /// Status 6 with the system's reason, or where a file has come into the way; that is as it was.
    pub fn publish(self) -> Result<(), Failure> {
        Ok(self.0.publish()?)
    }
}
