//! Identity of files: tests if two paths lead to one file without opening either, as an input may be a pipe.

use std::path::{Path, PathBuf};

/// Members of a folder that are looked at, and how deep: as deep as a recording's folder is read.
const MEMBERS: usize = 10_000;
const DEPTH: usize = 2;

/// Results that may lie in the folder of the recording they are of; documents only where they are ours.
const RESULTS: [&str; 5] = ["html", "svg", "png", "rs", "partial"];
/// One of these is at the beginning of every document that we write.
const OURS: [&[u8]; 4] = [
    b"\"schema\": \"stillpoint",
    b"\"created_by\": \"stillpoint",
    b"\"dynamic\": [",
    b"\"motion\": {",
];

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
    let identity = of(target);
    let is = |path: &Path| identity.is_some() && of(path) == identity;
    let held = |folder: &Path| {
        let found = members(folder);
        found.iter().any(|path| is(path) && !is_result(path))
    };
    let is_input = |input: &&Path| match input.as_os_str().as_encoded_bytes() {
        b"-" => identity.is_some() && of_standard_input() == identity,
        // What is to be written elsewhere in this run may not be there yet.
        _ => is(input) || resolve(input) == target || input.is_dir() && held(input),
    };
    inputs.iter().copied().find(is_input)
}

/// The files in a folder.
fn members(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![(folder.to_owned(), 0)];
    while let Some((folder, depth)) = folders.pop() {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        for path in entries.take(MEMBERS).map(|entry| entry.path()) {
            match path.is_dir() {
                true if depth < DEPTH => folders.push((path, depth + 1)),
                true => {}
                false if files.len() < MEMBERS => files.push(path),
                false => return files,
            }
        }
    }
    files
}

/// Returns true if a file in a recording's folder is a result of an earlier run.
fn is_result(path: &Path) -> bool {
    use std::io::Read;
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("json") => {
            let mut begin = Vec::new();
            let file = std::fs::File::open(path);
            let read = file.and_then(|file| file.take(4096).read_to_end(&mut begin));
            let holds = |mark: &&[u8]| begin.windows(mark.len()).any(|part| part == *mark);
            read.is_ok() && OURS.iter().any(holds)
        }
        Some(other) => RESULTS.contains(&other),
        None => false,
    }
}

/// Returns true if both paths lead to the same existing file.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    of(one).is_some_and(|identity| of(other) == Some(identity))
}

/// Returns the identity of a file: device and inode number.
#[cfg(unix)]
fn of(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    let found = std::fs::metadata(path).ok()?;
    Some((found.dev(), found.ino()))
}

/// Returns the identity of a file: its canonical path. Hard links are not recognised.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_in_the_folder_of_its_recording_is_told_from_the_recording() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("meta")).unwrap();
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path
        };
        let cal = write("cal.json", "{\n  \"schema\": \"stillpoint.calibration/1\"");
        let page = write("cal.html", "<html>");
        let recordings = [
            write("rec.json", "[{\"t\": 0, \"ax\": 1}]"),
            write("acc.csv", "t,ax,ay,az"),
            write("meta/time.csv", "event"),
            write("log", "bytes"),
        ];
        let is_input = |path: &Path| input_at(&resolve(path), &[folder.path()]).is_some();
        assert!(!is_input(&cal) && !is_input(&page));
        assert!(!is_input(&folder.path().join("new.csv")));
        assert!(recordings.iter().all(|path| is_input(path)));
        let linked = folder.path().with_extension("hard");
        std::fs::hard_link(&recordings[1], &linked).unwrap();
        assert!(is_input(&linked));
        std::fs::remove_file(linked).unwrap();
    }

    #[test]
    fn an_input_that_is_not_there_yet_is_one_all_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("events");
        let target = resolve(&folder.path().join("./events"));
        assert!(input_at(&target, &[&path]).is_some());
    }
}
