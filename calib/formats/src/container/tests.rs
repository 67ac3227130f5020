//! Archives as they are made here, and as attackers make them.

use super::*;
use crate::make::{Packing, zip};

fn limits() -> Limits {
    Limits {
        bytes: 8 << 20,
        ..Limits::default()
    }
}

fn content(container: &Container, name: &str) -> std::io::Result<Vec<u8>> {
    let entry = container.entries().iter().find(|e| e.name == name).unwrap();
    let mut bytes = Vec::new();
    let mut reader = container.open(entry).map_err(std::io::Error::other)?;
    reader.read_to_end(&mut bytes)?;
    Ok(bytes)
}

#[test]
fn entries_are_what_was_packed_and_names_that_lead_out_are_left_out() {
    let text = b"1,2,3\n".repeat(5000);
    let archive = zip(&[
        ("b/Gyro.csv", &text, Packing::Deflated),
        ("a.csv", b"short", Packing::Stored),
        ("../../x", b"evil", Packing::Stored),
        ("/etc/x", b"evil", Packing::Stored),
        ("C:\\x", b"evil", Packing::Stored),
    ]);
    let container = Container::zip_in_memory(archive, limits()).unwrap();
    let names: Vec<_> = container.entries().iter().map(|e| &e.name[..]).collect();
    assert_eq!(names, ["a.csv", "b/Gyro.csv"]);
    assert_eq!(container.warnings.len(), 3);
    assert_eq!(content(&container, "b/Gyro.csv").unwrap(), text);
    assert_eq!(content(&container, "a.csv").unwrap(), b"short");
}

#[test]
fn bombs_are_refused_before_they_go_off() {
    let zeros = vec![0; 4 << 20];
    let archive = zip(&[("a.csv", &zeros, Packing::Deflated)]);
    let container = Container::zip_in_memory(archive, limits()).unwrap();
    let error = content(&container, "a.csv").unwrap_err().to_string();
    assert!(error.contains("1000 times"), "{error}");
    let large = zip(&[
        ("a", &zeros, Packing::Deflated),
        ("b", &zeros, Packing::Deflated),
        ("c", b"1", Packing::Stored),
    ]);
    let error = Container::zip_in_memory(large, limits()).unwrap_err();
    assert!(error.to_string().contains("unpacks to"), "{error}");
    let many: Vec<(String, &[u8], Packing)> = (0..10_001)
        .map(|k| (k.to_string(), &b""[..], Packing::Stored))
        .collect();
    let many: Vec<_> = many.iter().map(|(n, c, p)| (&n[..], *c, *p)).collect();
    let error = Container::zip_in_memory(zip(&many), limits()).unwrap_err();
    assert!(error.to_string().contains("10000 entries"), "{error}");
    // Both entries are the same bytes.
    let mut twice = zip(&[
        ("a", b"content", Packing::Stored),
        ("b", b"content", Packing::Stored),
    ]);
    let second = twice.windows(4).rposition(|w| w == b"PK\x01\x02").unwrap();
    twice[second + 42..second + 46].fill(0);
    let error = Container::zip_in_memory(twice, limits()).unwrap_err();
    assert!(error.to_string().contains("overlap"), "{error}");
}

#[test]
fn damage_is_told_wherever_it_is() {
    let whole = zip(&[("a.csv", &b"1,2,3\n".repeat(100), Packing::Stored)]);
    for length in 0..whole.len() {
        let cut = Container::zip_in_memory(whole[..length].to_vec(), limits());
        assert!(cut.is_err(), "{length} of {} bytes", whole.len());
    }
    for at in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x10;
        if let Ok(container) = Container::zip_in_memory(damaged, limits()) {
            for entry in container.entries() {
                let mut bytes = Vec::new();
                let read = container.open(entry).map(|mut r| r.read_to_end(&mut bytes));
                let same = bytes == b"1,2,3\n".repeat(100);
                assert!(
                    same || !matches!(read, Ok(Ok(_))) || entry.name != "a.csv",
                    "byte {at}"
                );
            }
        }
    }
    let mut encrypted = whole.clone();
    let header = whole.windows(4).position(|w| w == b"PK\x01\x02").unwrap();
    encrypted[header + 8] |= 1;
    let error = Container::zip_in_memory(encrypted, limits()).unwrap_err();
    assert!(
        error.to_string().contains("`a.csv` is encrypted"),
        "{error}"
    );
}

#[test]
fn a_folder_is_its_files() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("meta")).unwrap();
    std::fs::write(folder.path().join("meta/time.csv"), "x").unwrap();
    std::fs::write(folder.path().join("Gyro.csv"), "1").unwrap();
    let container = Container::folder(folder.path(), limits()).unwrap();
    let names: Vec<_> = container.entries().iter().map(|e| &e.name[..]).collect();
    assert_eq!(names, ["Gyro.csv", "meta/time.csv"]);
    assert_eq!(content(&container, "meta/time.csv").unwrap(), b"x");
}

#[cfg(unix)]
#[test]
fn a_file_of_a_folder_that_the_system_does_not_tell_of_is_no_file_left_out() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("acc.csv"), "1").unwrap();
    let link = |aim: &str, name: &str| std::os::unix::fs::symlink(aim, folder.path().join(name));
    link("nowhere", "gone.csv").unwrap();
    let container = Container::folder(folder.path(), limits()).unwrap();
    assert_eq!(container.entries().len(), 1);
    // A circle of links: what is there cannot be found out.
    link("gyro.csv", "gyro.csv").unwrap();
    let error = Container::folder(folder.path(), limits()).unwrap_err();
    assert!(error.to_string().contains("gyro.csv: "), "{error}");
}

/// A disk that fails.
struct Failing;

impl std::io::Read for Failing {
    fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
        Err(std::io::Error::other("the disk fails"))
    }
}

impl std::io::Seek for Failing {
    fn seek(&mut self, _: std::io::SeekFrom) -> std::io::Result<u64> {
        Ok(0)
    }
}

#[test]
fn a_disk_that_fails_is_no_damage_of_an_archive() {
    let packed = Packed {
        at: 0,
        packed_size: 1,
        size: 1,
        crc: 0,
        method: 0,
    };
    let failed = entry::unpacked(Box::new(Failing), &packed).err().unwrap();
    assert_eq!(
        failed.to_string(),
        Error::Io(std::io::Error::other("the disk fails")).to_string()
    );
}
