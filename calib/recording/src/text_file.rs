//! Small text files: calibrations, specs, effect files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use findings::{Finding, Kind};

use crate::Error;
use crate::shown::shown_path;
use crate::source::on_disk::explained;
use crate::source::place::{at_line, in_file};

/// No such file is larger. A device or a pipe without end is refused here instead of filling the memory.
const LARGEST: u64 = 64 << 20;

/// All of a text file that a person or this program has written; not for recordings.
///
/// # Errors
/// [`Error::Io`] where it cannot be read; [`Error::Input`] for a folder, more than 64 MiB, or bytes that are no
/// UTF-8, with the place.
pub fn read_text(path: &Path) -> Result<String, Error> {
    if path.is_dir() {
        return Err(in_file(
            &shown_path(path),
            Finding::of(Kind::FOLDER_AS_FILE),
        ));
    }
    let file = File::open(path).map_err(|error| explained(path, error))?;
    let mut bytes = Vec::new();
    let read = file.take(LARGEST + 1).read_to_end(&mut bytes);
    read.map_err(|error| explained(path, error))?;
    if bytes.len() as u64 > LARGEST {
        return Err(in_file(
            &shown_path(path),
            Finding::of(Kind::TEXT_TOO_LARGE),
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + memchr::memchr_iter(b'\n', before).count();
        at_line(&shown_path(path), line as u64, Finding::of(Kind::NOT_UTF8))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_text_is_refused_with_its_place() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.toml");
        std::fs::write(&path, "µ = 1\n").unwrap();
        assert_eq!(read_text(&path).unwrap(), "µ = 1\n");
        std::fs::write(&path, b"a = 1\nb = \xff\n").unwrap();
        let message = read_text(&path).unwrap_err().to_string();
        assert!(message.contains("a.toml:2: no UTF-8"), "{message}");
        let message = read_text(dir.path()).unwrap_err().to_string();
        assert!(message.contains("a folder"), "{message}");
        let message = read_text(&dir.path().join("b.toml")).unwrap_err();
        assert!(message.to_string().contains("nearest: a.toml"), "{message}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_without_end_is_refused() {
        let message = read_text(Path::new("/dev/zero")).unwrap_err().to_string();
        assert!(message.contains("more than 64 MiB"), "{message}");
    }
}
