//! Whether two paths are one file, found without opening either: an input may be a pipe.

use std::path::{Path, PathBuf};

/// Members of a folder that are looked at.
const MEMBERS: usize = 10_000;

/// Results that may lie in the folder of the recording they are of.
const RESULTS: [&str; 6] = ["json", "html", "svg", "png", "rs", "partial"];

/// The file that the path stands for, links followed; one that is not there yet by its folder.
pub fn resolve(path: &Path) -> PathBuf {
    let beside = || {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
        Some(folder.join(path.file_name()?))
    };
    let found = path.canonicalize().ok().or_else(beside);
    found.unwrap_or_else(|| path.to_owned())
}

/// The input that `target` is, through links of either kind, or that it is a file of.
pub fn input_at<'a>(target: &Path, inputs: &[&'a Path]) -> Option<&'a Path> {
    let identity = of(target)?;
    let is = |path: &Path| of(path).is_some_and(|other| other == identity);
    let held = |folder: &Path| {
        let members = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let members = members.take(MEMBERS).map(|entry| entry.path());
        let recorded = |path: &PathBuf| {
            let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
            !extension.is_some_and(|e| RESULTS.contains(&e.as_str()))
        };
        members.filter(recorded).any(|path| is(&path))
    };
    let is_input = |input: &&Path| match input.as_os_str().as_encoded_bytes() {
        b"-" => of_standard_input().is_some_and(|other| other == identity),
        _ => is(input) || input.is_dir() && held(input),
    };
    inputs.iter().copied().find(is_input)
}

/// Whether both paths lead to one file that is there.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    of(one).is_some_and(|identity| of(other) == Some(identity))
}

/// What tells a file from every other: device and number.
#[cfg(unix)]
fn of(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    let found = std::fs::metadata(path).ok()?;
    Some((found.dev(), found.ino()))
}

/// What tells a file from every other, hard links not seen: its path.
#[cfg(not(unix))]
fn of(path: &Path) -> Option<PathBuf> {
    path.canonicalize().ok()
}

#[cfg(unix)]
fn of_standard_input() -> Option<(u64, u64)> {
    use std::os::fd::AsFd;
    use std::os::unix::fs::MetadataExt;
    let own = std::io::stdin().as_fd().try_clone_to_owned().ok()?;
    let found = std::fs::File::from(own).metadata().ok()?;
    Some((found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn of_standard_input() -> Option<PathBuf> {
    None
}
