//! `convert` loses nothing without a word.

use std::path::{Path, PathBuf};

use crate::common::{files, folder, json, status, stderr, stillpoint};

/// A folder with `all.csv`: both sensors, a temperature that rises, a field, a pressure and marks.
fn furnished() -> (tempfile::TempDir, PathBuf) {
    let (dir, path) = folder();
    let text = std::fs::read_to_string(path.join("good.csv")).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap();
    let mut all = format!("{names},temp,mx (uT),my (uT),mz (uT),pressure,mark\n");
    for line in lines {
        let t: f64 = line.split(',').next().unwrap().parse().unwrap();
        let (celsius, [x, y]) = (20.0 + 0.02 * t, [30.0 * t.sin(), 30.0 * t.cos()]);
        all += &format!("{line},{celsius},{x},{y},-20.5,1013.2,3\n");
    }
    std::fs::write(path.join("all.csv"), all).unwrap();
    (dir, path)
}

/// Converts, and returns what was said.
fn converted(folder: &Path, from: &str, to: &[&str]) -> String {
    let run = stillpoint(folder, &[&["convert", from, "-o"], to].concat());
    assert_eq!(status(&run), 0, "{from} {to:?}: {}", stderr(&run));
    stderr(&run)
}

#[test]
fn a_folder_keeps_the_temperature_and_gives_back_the_table() {
    let (_dir, folder) = furnished();
    converted(&folder, "all.csv", &["plain.csv"]);
    converted(&folder, "all.csv", &["plain"]);
    assert_eq!(
        files(&folder.join("plain")),
        ["acc.csv", "gyro.csv", "mag.csv", "temp.csv"]
    );
    converted(&folder, "plain", &["back.csv"]);
    converted(&folder, "plain", &["again"]);
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    assert!(read("plain.csv") == read("back.csv"));
    for name in files(&folder.join("plain")) {
        let [first, second] = ["plain", "again"].map(|folder| read(&format!("{folder}/{name}")));
        assert!(first == second, "{name}");
    }
    let effect = |recording: &str| {
        let call = ["calibrate", recording, "--gravity", "9.80665", "--effects"];
        let run = stillpoint(
            &folder,
            &[&call[..], &["accel_temperature", "--json"]].concat(),
        );
        assert!(
            [0, 1].contains(&status(&run)),
            "{recording}: {}",
            stderr(&run)
        );
        json(&run)["effects"].clone()
    };
    assert_eq!(effect("plain")[0]["name"], "accel_temperature");
    assert_eq!(effect("plain"), effect("all.csv"));
}

#[test]
fn columns_that_are_not_written_are_named_in_both_forms() {
    let (_dir, folder) = furnished();
    for to in ["plain", "plain.csv"] {
        let said = converted(&folder, "all.csv", &[to]);
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains("not written: `pressure`, `mark`"), "{said}");
    }
    let said = converted(&folder, "good.csv", &["good"]);
    assert!(said.is_empty(), "{said}");
}

#[test]
fn a_file_of_an_earlier_recording_in_the_folder_is_pointed_out() {
    let (_dir, folder) = furnished();
    converted(&folder, "all.csv", &["plain"]);
    let said = converted(&folder, "good.csv", &["plain", "--force"]);
    for name in ["plain/mag.csv", "plain/temp.csv"] {
        assert!(said.contains(name), "{said}");
    }
}

#[test]
fn samples_that_one_table_has_no_row_for_are_counted() {
    let (_dir, folder) = furnished();
    converted(&folder, "good.csv", &["plain"]);
    let gyro = std::fs::read_to_string(folder.join("plain/gyro.csv")).unwrap();
    let kept: Vec<&str> = gyro.lines().collect();
    let cut = kept[..kept.len() - 50].join("\n");
    std::fs::write(folder.join("plain/gyro.csv"), cut).unwrap();
    let said = converted(&folder, "plain", &["table.csv"]);
    assert!(said.contains("50 samples from when"), "{said}");
    let said = converted(&folder, "plain", &["again"]);
    assert!(!said.contains("samples from when"), "{said}");
}
