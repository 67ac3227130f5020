//! What the system refuses is said; it is never taken for something else, and nothing is left out for it. `tests/io_failures.py` lets
//! every read and write of every command fail.
#![cfg(target_os = "linux")]

use std::fs::File;
use std::os::unix::fs::symlink;
use std::process::Command;

use crate::common::{folder, status, stderr, stillpoint};

#[test]
fn help_and_version_that_a_full_disk_does_not_take_are_status_6() {
    for words in [&["--version"][..], &["--help"], &["calibrate", "--help"]] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let mut program = Command::new(env!("CARGO_BIN_EXE_stillpoint"));
        let run = program.args(words).stdout(full).output().unwrap();
        assert_eq!(status(&run), 6, "{words:?}: {}", stderr(&run));
        let said = stderr(&run);
        assert!(said.contains("standard output cannot be written"), "{said}");
    }
}

#[test]
fn a_file_that_the_system_does_not_tell_of_is_named_and_not_passed_over() {
    let (_dir, folder) = folder();
    // A circle of links: whether there is something cannot be found out.
    symlink("phone.csv", folder.join("phone.csv")).unwrap();
    let device = folder.join("out/devices/a");
    std::fs::create_dir_all(&device).unwrap();
    symlink("cal.json", device.join("cal.json")).unwrap();
    let calls: [(&[&str], &str); 2] = [
        (&["phone.csv"], "phone.csv"),
        (&["batch", "prior", "out", "-o", "prior.json"], "a/cal.json"),
    ];
    for (call, name) in calls {
        let run = stillpoint(&folder, call);
        assert_eq!(status(&run), 3, "{call:?}: {}", stderr(&run));
        assert!(stderr(&run).contains(name), "{call:?}: {}", stderr(&run));
    }
}

#[test]
fn a_file_beside_a_sensor_that_cannot_be_looked_into_is_not_left_out() {
    let (_dir, folder) = folder();
    let made = stillpoint(&folder, &["convert", "good.csv", "-o", "phone"]);
    assert_eq!(status(&made), 0, "{}", stderr(&made));
    std::fs::remove_file(folder.join("phone/gyro.csv")).unwrap();
    // Reading at the address 0 fails as a broken disk does.
    symlink("/proc/self/mem", folder.join("phone/turns.csv")).unwrap();
    let run = stillpoint(&folder, &["segment", "phone"]);
    assert_eq!(status(&run), 3, "{}", stderr(&run));
    let said = stderr(&run);
    assert!(
        said.contains("phone/turns.csv") && said.contains("Input/output error"),
        "{said}"
    );
}
