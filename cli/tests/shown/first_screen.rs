//! The first screen: the verdict first, and no more than a terminal of 24 lines and 80 columns shows.

use std::path::{Path, PathBuf};
use stillpoint_tests::needed_data;

use crate::common::{status, stderr, stdout, stillpoint};
use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};

const LINES: usize = 24;
const COLUMNS: usize = 80;

/// Runs a command, whose output and messages together fill one terminal at most.
#[track_caller]
fn on_one_screen(folder: &Path, args: &[&str]) -> String {
    let run = stillpoint(folder, args);
    let (said, remarks) = (stdout(&run), stderr(&run));
    assert_eq!(status(&run), 0, "{args:?}: {remarks}");
    let all = format!("{said}{remarks}");
    assert!(all.lines().count() <= LINES, "{args:?}:\n{all}");
    for line in all.lines() {
        assert!(line.chars().count() <= COLUMNS, "{args:?}: {line}");
    }
    said
}

/// A folder with `good.csv`, a session that begins with half a minute at rest.
fn folder() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let mut spec = Spec::hand_held(11);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(14),
        initial_rest: Some(30.0),
        ..HandHeld::default()
    });
    let path = dir.path().to_owned();
    let mut session = spec.run().unwrap();
    std::fs::write(path.join("good.csv"), to_csv(&mut session.recording)).unwrap();
    (dir, path)
}

/// The commands over the recordings of a device; the first is looked at on its own.
fn every_command(folder: &Path, recordings: &[&str]) {
    let one = recordings[0];
    let with = |command: &str, more: &[&str]| {
        let words = [&[command][..], recordings, more].concat();
        on_one_screen(folder, &words)
    };
    let said = with("calibrate", &["-o", "cal.json"]);
    let levels = ["Good: ", "With care: ", "Not to be used: "];
    assert!(levels.iter().any(|level| said.starts_with(level)), "{said}");
    assert!(
        said.contains("scale, ppm") && said.contains("weakest parameter"),
        "{said}"
    );
    assert!(said.contains("Wrote cal.json."), "{said}");
    let next = said.split_once("\nNext\n").unwrap().1;
    assert!(next.contains("stillpoint "), "{said}");
    let said = with("discover", &["-o", "findings.json"]);
    let verdict: Vec<&str> = said
        .split("\n\n")
        .next()
        .unwrap()
        .split_whitespace()
        .collect();
    assert!(verdict.len() <= 30, "{} words: {said}", verdict.len());
    assert!(levels.iter().any(|level| said.starts_with(level)), "{said}");
    on_one_screen(folder, &["evaluate", one, "--calibration", "cal.json"]);
    on_one_screen(folder, &["bias", "cal.json", one, "-o", "today.json"]);
    on_one_screen(folder, &["segment", one]);
    on_one_screen(folder, &["info", one]);
    for command in [&["calibrate"][..], &["discover"]] {
        let quiet = stillpoint(folder, &[command, recordings, &["-q"]].concat());
        assert!(stdout(&quiet).lines().count() <= 4, "{}", stdout(&quiet));
        assert_eq!(stderr(&quiet), "");
    }
}

#[test]
fn every_command_fills_one_screen_on_a_simulated_session() {
    let (_dir, folder) = folder();
    every_command(&folder, &["good.csv"]);
    on_one_screen(&folder, &["allan", "good.csv", "--rest", "0,19"]);
    let devices = folder.join("devices");
    std::fs::create_dir(&devices).unwrap();
    for k in 0..30 {
        std::fs::copy(
            folder.join("good.csv"),
            devices.join(format!("unit_{k}.csv")),
        )
        .unwrap();
    }
    let said = on_one_screen(&folder, &["batch", "devices", "-o", "out"]);
    assert!(said.starts_with("30 of 30 devices pass"), "{said}");
}

#[test]
fn the_demonstration_fills_one_screen_and_says_that_it_is_simulated() {
    let (_dir, folder) = folder();
    for args in [&["demo"][..], &["demo", "--out", "demo"]] {
        let said = on_one_screen(&folder, args);
        assert!(said.starts_with("The hidden effect is found"), "{said}");
        assert!(said.lines().next().unwrap().contains("simulated"), "{said}");
        assert!(
            said.contains("truth") && said.contains("estimate"),
            "{said}"
        );
    }
}

/// What `-v` adds is what stands behind the screen, in SI units.
#[test]
fn details_stand_behind_the_screen() {
    let (_dir, folder) = folder();
    let brief = stdout(&stillpoint(&folder, &["calibrate", "good.csv"]));
    let whole = stillpoint(&folder, &["calibrate", "good.csv", "-v"]);
    let said = stdout(&whole);
    assert_eq!(brief.lines().next(), said.lines().next());
    for words in [
        "std error",
        "alpha_yz",
        "heading error per turn",
        "condition",
    ] {
        assert!(said.contains(words) && !brief.contains(words), "{words}");
    }
    assert!(
        stderr(&whole).contains("the local gravity (--gravity)"),
        "{}",
        stderr(&whole)
    );
}

/// Two recordings whose files have one name are told apart by their folders, and a path is in no table.
#[test]
fn recordings_have_short_names_that_no_other_has() {
    let (_dir, folder) = folder();
    let text = std::fs::read_to_string(folder.join("good.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    for (day, count) in [("day_1", lines.len()), ("day_2", lines.len() * 9 / 10)] {
        let day = folder.join("long/way/to").join(day);
        std::fs::create_dir_all(&day).unwrap();
        std::fs::write(day.join("run.csv"), lines[..count].join("\n")).unwrap();
    }
    let args = [
        "calibrate",
        "long/way/to/day_1/run.csv",
        "long/way/to/day_2/run.csv",
        "-v",
        "--force-device",
    ];
    let run = stillpoint(&folder, &args);
    let said = stdout(&run);
    assert_eq!(status(&run), 0, "{said}{}", stderr(&run));
    let (screen, details) = said.split_once("Accelerometer   a = T").unwrap();
    assert!(!details.contains("long/way"), "{details}");
    // But a command has them as they are typed.
    assert!(screen.contains("long/way/to/day_1/run.csv"), "{screen}");
}

#[test]
fn every_command_fills_one_screen_on_the_phones_recordings() {
    let Some(phone) = needed_data::needed("phone") else {
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    for name in ["rec_1", "rec_2", "rec_3"] {
        let from = phone
            .join("multi_position")
            .join(name)
            .canonicalize()
            .unwrap();
        std::os::unix::fs::symlink(from, dir.path().join(name)).unwrap();
    }
    every_command(dir.path(), &["rec_1", "rec_2"]);
    on_one_screen(
        dir.path(),
        &["evaluate", "rec_3", "--calibration", "cal.json"],
    );
    on_one_screen(dir.path(), &["allan", "rec_2"]);
}

/// The level in a document, with the words that terminal and page have for it.
fn level(document: &str) -> (String, [&'static str; 2]) {
    let document: serde_json::Value = serde_json::from_str(document).unwrap();
    let level = document["verdict"]["level"].as_str().unwrap().to_owned();
    let words = match level.as_str() {
        "good" => ["Good: ", "the calibration can be used"],
        "care" => ["With care: ", "Usable with care: "],
        _ => ["Not to be used: ", "Do not use this calibration: "],
    };
    (level, words)
}

#[test]
fn the_verdict_is_the_same_in_terminal_page_file_json_and_batch() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("devices");
    std::fs::create_dir(&folder).unwrap();
    let session = |effect: Option<&str>| {
        let mut spec = Spec::hand_held(23);
        spec.rate = 50.0;
        if let Some(effect) = effect {
            spec = spec.with_effect(effect, 5.0);
        }
        spec.run().unwrap().recording
    };
    let mut clean = session(None);
    let mut lacking = session(Some("accel_quadratic"));
    let mut halved = session(None);
    let readings = halved.gyroscope.iter_mut().flat_map(|s| &mut s.values);
    readings.for_each(|w| *w *= 0.5);
    let expected = [("clean", "good"), ("halved", "bad"), ("lacking", "care")];
    std::fs::write(folder.join("clean.csv"), to_csv(&mut clean)).unwrap();
    std::fs::write(folder.join("halved.csv"), to_csv(&mut halved)).unwrap();
    std::fs::write(folder.join("lacking.csv"), to_csv(&mut lacking)).unwrap();
    let gravity = ["--gravity", "9.80665"];
    for (name, expected) in expected {
        let file = format!("{name}.csv");
        let outputs = ["-o", "cal.json", "--report", "cal.html", "--force"];
        let call = ["calibrate", &file];
        let run = stillpoint(&folder, &[&call[..], &gravity, &outputs].concat());
        let said = stdout(&run);
        let document = std::fs::read_to_string(folder.join("cal.json")).unwrap();
        let (own, [terminal, page]) = level(&document);
        assert_eq!(own, expected, "{name}: {said}");
        assert!(said.starts_with(terminal), "{name}: {said}");
        let shown = std::fs::read_to_string(folder.join("cal.html")).unwrap();
        assert!(shown.contains(page), "{name}");
        let json = stillpoint(&folder, &[&call[..], &gravity, &["--json"]].concat());
        assert_eq!(stdout(&json), document, "{name}");
    }
    let batch = ["batch", "devices", "-o", "lot"];
    stillpoint(dir.path(), &[&batch[..], &gravity].concat());
    stillpoint(dir.path(), &["batch", "merge", "lot", "-o", "all", "--csv"]);
    let table = std::fs::read_to_string(dir.path().join("all.csv")).unwrap();
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let place = |name: &str| header.iter().position(|own| *own == name).unwrap();
    let (id, verdict) = (place("id"), place("calibration_verdict"));
    for (name, expected) in expected {
        let row = lines.clone().find(|row| row[id].contains(name)).unwrap();
        let found = row.contains(&expected);
        assert!(found && verdict > id, "{name}: {row:?}");
    }
}
