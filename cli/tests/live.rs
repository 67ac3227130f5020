//! `live` with a simulated phone, a person who reads what it says, text that comes, and a browser.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod common;

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use calib::Recording;
use calib::recording::ReadOptions;
use common::{folder, json, status, stderr, stillpoint};
use stillpoint_tests::live::{Server, phone};

/// Starts `stillpoint live` with a phone whose person reads `events.ndjson`.
fn start(folder: &Path, server: &Server, poll: &str, more: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .current_dir(folder)
        .args([
            "live",
            &server.address,
            "--out",
            "session",
            "--events",
            "events.ndjson",
            "--poll",
            poll,
        ])
        .args(more)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn a_person_who_does_what_it_says_gets_a_calibration() {
    let dir = tempfile::tempdir().unwrap();
    let server = Server::start(phone(2).with_events(&dir.path().join("events.ndjson"))).unwrap();
    let run = start(
        dir.path(),
        &server,
        "0",
        &["--gravity", "9.80665", "--json", "-o", "cal.json"],
    );
    let run = run.wait_with_output().unwrap();
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let calibration = json(&run);
    assert!(calibration["accelerometer"].is_object() && calibration["gyroscope"].is_object());
    assert!(server.phone().person.placements <= 14);
    assert!(
        dir.path().join("cal.json").is_file() && dir.path().join("session/phyphox.zip").is_file()
    );
    let said = stderr(&run);
    assert!(
        said.contains("Hold still") && said.contains("turn it, ") && said.contains("Enough"),
        "{said}"
    );
    // The same by the command that it names.
    let again = stillpoint(
        dir.path(),
        &[
            "calibrate",
            "session/phyphox.zip",
            "--gravity",
            "9.80665",
            "--json",
        ],
    );
    assert_eq!(json(&again), calibration);
}

#[test]
fn nothing_that_came_is_lost_when_it_is_killed() {
    let dir = tempfile::tempdir().unwrap();
    let events = dir.path().join("events.ndjson");
    let server = Server::start(phone(0).with_events(&events)).unwrap();
    let mut run = start(dir.path(), &server, "0", &[]);
    let begin = Instant::now();
    let placements = |text: &str| text.contains("\"placements\":4");
    while !placements(&std::fs::read_to_string(&events).unwrap_or_default()) {
        assert!(
            begin.elapsed() < Duration::from_secs(120),
            "no fourth placement"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    let sent = server.phone().sent;
    let read = |name: &str| {
        std::fs::read_to_string(dir.path().join("session/received").join(name)).unwrap()
    };
    for (name, sent) in ["acc.csv", "gyro.csv"].iter().zip(sent) {
        let text = read(name);
        assert!(text.ends_with('\n'), "{name} ends within a line");
        let rows = text.lines().count() - 1;
        // The last answer may not have arrived: a quarter of a second at 100 Hz.
        assert!(
            rows <= sent && rows + 30 >= sent,
            "{name}: {rows} rows of {sent} that were sent"
        );
    }
    let recording = Recording::read(
        &dir.path().join("session/received"),
        &ReadOptions::default(),
    )
    .unwrap();
    assert!(recording.accelerometer.unwrap().len() + 30 >= sent[0]);
}

#[test]
fn text_from_standard_input_is_kept_and_calibrated_as_the_file_would_be() {
    let (_dir, path) = folder();
    let text = std::fs::read(path.join("good.csv")).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .current_dir(&path)
        .args([
            "live",
            "-",
            "--out",
            "session",
            "--poll",
            "0.02",
            "--gravity",
            "9.80665",
            "--placements",
            "60",
            "--json",
        ])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    run.stdin.take().unwrap().write_all(&text).unwrap();
    let run = run.wait_with_output().unwrap();
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    assert_eq!(std::fs::read(path.join("session/lines.txt")).unwrap(), text);
    let by_file = json(&stillpoint(
        &path,
        &["calibrate", "good.csv", "--gravity", "9.80665", "--json"],
    ));
    assert_eq!(json(&run)["accelerometer"], by_file["accelerometer"]);
    assert_eq!(json(&run)["gyroscope"], by_file["gyroscope"]);
}

#[test]
fn a_source_that_is_none_and_a_phone_that_is_away_say_what_to_do() {
    let dir = tempfile::tempdir().unwrap();
    let none = stillpoint(dir.path(), &["live", "no-such-file"]);
    assert_eq!(status(&none), 2, "{}", stderr(&none));
    let away = stillpoint(dir.path(), &["live", "http://127.0.0.1:9"]);
    assert_eq!(status(&away), 3);
    assert!(
        stderr(&away).contains("Allow remote access"),
        "{}",
        stderr(&away)
    );
    assert!(
        common::files(dir.path()).is_empty(),
        "no folder is left where nothing came"
    );
}

/// Says that a test is skipped, uncaptured.
fn skipped(why: &str) {
    let _ = writeln!(
        std::io::stderr(),
        "skipped: {}: {why}",
        std::thread::current().name().unwrap_or("a test")
    );
}

#[test]
fn the_page_shows_the_session_in_a_browser() {
    let Some(chromium) = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| {
            Command::new(name)
                .arg("--version")
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status()
                .is_ok_and(|s| s.success())
        })
    else {
        return skipped("no chromium");
    };
    let dir = tempfile::tempdir().unwrap();
    let server = Server::start(phone(5)).unwrap();
    server.phone().tell(live::Instruction::LayDown);
    let mut run = start(dir.path(), &server, "0.05", &["--web"]);
    let said = BufReader::new(run.stderr.take().unwrap());
    let address = said
        .lines()
        .map_while(Result::ok)
        .find_map(|line| Some(line.split_once("http://127.0.0.1:")?.1.to_owned()));
    let address = address.filter(|a| a.contains("in a browser")).unwrap();
    let address = format!("http://127.0.0.1:{}", address.split(' ').next().unwrap());
    let browser = Command::new(chromium)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--enable-logging=stderr",
            "--virtual-time-budget=4000",
            "--dump-dom",
            &address,
        ])
        .output()
        .unwrap();
    run.kill().unwrap();
    run.wait().unwrap();
    let page = String::from_utf8_lossy(&browser.stdout).into_owned();
    let log = String::from_utf8_lossy(&browser.stderr).into_owned();
    assert!(
        page.contains("class=\"free\"") && page.contains("class=\"edge\""),
        "{page}"
    );
    assert!(
        !log.contains("CONSOLE") && !log.contains("Content Security Policy"),
        "{log}"
    );
}
