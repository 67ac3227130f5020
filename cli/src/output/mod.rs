//! Result files: written whole or not at all.
//!
//! An [`Output`] is claimed before anything is computed, so that a folder that cannot be written, a
//! file in the way or a second run are found at once. It is written to a [partial file](partial) beside
//! the target, synced and renamed; what had been there is as it was until then.

mod folder;
mod identity;
mod partial;
mod refusal;

use std::fs::Metadata;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;

use self::refusal::{not_written, refused};
use crate::exit::{Failure, USAGE};
use crate::show;
pub use folder::Folder;
pub use identity::is_same_file;
use partial::{Partial, Published};

/// What to do where an output exists.
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

    /// Whether existing files are replaced.
    pub fn force(self) -> bool {
        self.force
    }

    /// Whether existing files are kept.
    pub fn skip_existing(self) -> bool {
        self.skip_existing
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
pub struct Output(Option<Claim>);

#[derive(Debug)]
struct Claim {
    target: PathBuf,
    force: bool,
    /// The file that is there and will be replaced.
    replaced: Option<Metadata>,
    partial: Partial,
}

/// An output that is complete but not in its place yet.
#[derive(Debug)]
pub struct Filled(Option<Claim>);

impl Output {
    /// Claims `path`; `inputs` are files and folders of recordings that it must not be or lie in.
    ///
    /// # Errors
    /// Status 2 where the path is an input or another output of this run; status 6 where it exists (without `--force`), is no
    /// regular file, lies in a folder that cannot be written, or is claimed by another run.
    pub fn claim(path: &Path, replace: Replace, inputs: &[&Path]) -> Result<Self, Failure> {
        let target = identity::resolve(path);
        if let Some(input) = identity::input_at(&target, inputs) {
            let (output, input) = (show::path(path), show::path(input));
            let why =
                format!("-o {output}: is the input {input} or a file of it; choose another name");
            return Err(Failure::new(USAGE, why));
        }
        let replaced = in_the_way(path, &target)?;
        if replaced.is_some() && replace.skip_existing {
            KEPT.fetch_add(1, Ordering::Relaxed);
            return Ok(Self(None));
        }
        if replaced.is_some() && !replace.force {
            let shown = show::path(path);
            return Err(Failure::exists(format!(
                "{shown}: exists already; add --force to replace it or --skip-existing to keep it"
            )));
        }
        let partial = Partial::create(path, &target, replaced.as_ref())?;
        CLAIMED.fetch_add(1, Ordering::Relaxed);
        Ok(Self(Some(Claim {
            target,
            force: replace.force,
            replaced,
            partial,
        })))
    }

    /// Puts `contents` in place of the target.
    ///
    /// # Errors
    /// Status 6 with the system's reason; the target is as it was.
    pub fn write(self, contents: &[u8]) -> Result<(), Failure> {
        self.fill(|out| out.write_all(contents))?.publish()
    }

    /// Writes what `fill` gives and syncs it; the target is as it was until [`Filled::publish`].
    ///
    /// # Errors
    /// Status 6 with the system's reason; the target is as it was.
    pub fn fill(
        self,
        fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<Filled, Failure> {
        let Some(mut claim) = self.0 else {
            return Ok(Filled(None));
        };
        let written = claim.partial.file().and_then(|file| {
            let mut out = BufWriter::new(file);
            fill(&mut out)?;
            out.flush()?;
            out.get_ref().sync_all()
        });
        match written {
            Ok(()) => Ok(Filled(Some(claim))),
            Err(error) => Err(not_written(&claim.target, &error)),
        }
    }
}

impl Filled {
    /// Renames the complete file to its target.
    ///
    /// # Errors
    /// Status 6 with the system's reason, or where a file has come into the way; that is as it was.
    pub fn publish(self) -> Result<(), Failure> {
        let Some(claim) = self.0 else { return Ok(()) };
        let (target, force) = (&claim.target, claim.force);
        match claim
            .partial
            .publish(target, force, claim.replaced.as_ref())
        {
            Published::Yes => Ok(()),
            Published::Exists => Err(Failure::exists(format!(
                "{}: was written by something else meanwhile and is left as it is; add --force to replace it",
                show::path(&claim.target)
            ))),
            Published::No(error) => Err(not_written(&claim.target, &error)),
        }
    }
}

/// The regular file that stands where the output is to go.
fn in_the_way(path: &Path, target: &Path) -> Result<Option<Metadata>, Failure> {
    let named_as_folder = path.as_os_str().as_encoded_bytes().ends_with(b"/");
    match std::fs::metadata(target) {
        Ok(found) if !found.is_file() => {
            Err(refused(path, "is no regular file; choose another name"))
        }
        Ok(found) if found.permissions().readonly() => Err(refused(
            path,
            "is write-protected; choose another name, or allow writing to it",
        )),
        Ok(found) => Ok(Some(found)),
        Err(_) if named_as_folder => Err(refused(path, "names a folder; name a file to write")),
        Err(_) if target.is_symlink() => {
            let aim = std::fs::read_link(target).map_or(String::new(), |aim| show::path(&aim));
            let why =
                format!("is a link to nothing ({aim}); remove the link or choose another name");
            Err(refused(path, &why))
        }
        Err(_) => Ok(None),
    }
}
