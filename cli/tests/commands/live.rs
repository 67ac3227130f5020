//! `live` with a simulated phone, a person who reads what it says, text that comes, and a browser.

use crate::common;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{folder, json, status, stderr, stillpoint};
use calib::Recording;
use calib::recording::ReadOptions;
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
    // Killed at any time: while the first placement lies, in a turn, in a pause, late.
    for (seed, samples) in [(0, 137), (1, 1861), (4, 3209), (2, 5003)] {
        let dir = tempfile::tempdir().unwrap();
        let events = dir.path().join("events.ndjson");
        let server = Server::start(phone(seed).with_events(&events)).unwrap();
        let mut run = start(dir.path(), &server, "0", &[]);
        let begin = Instant::now();
        while server.phone().sent[0] < samples {
            assert!(begin.elapsed() < Duration::from_secs(120), "seed {seed}");
            std::thread::sleep(Duration::from_micros(700));
        }
        run.kill().unwrap();
        run.wait().unwrap();
        let received = dir.path().join("session/received");
        let taken = server.phone().taken;
        let sent = server.phone().sent;
        for (name, (taken, sent)) in ["acc.csv", "gyro.csv"]
            .iter()
            .zip(taken.into_iter().zip(sent))
        {
            let text = std::fs::read_to_string(received.join(name)).unwrap();
            assert!(text.ends_with('\n'), "{name} ends within a line");
            let rows = text.lines().count() - 1;
            // Who asks again has written what was answered before; only the last answer may not have arrived.
            assert!(
                (taken..=sent).contains(&rows),
                "seed {seed}, {name}: {rows} rows; {taken} were taken, {sent} sent"
            );
        }
        let recording = Recording::read(&received, &ReadOptions::default()).unwrap();
        assert!(recording.accelerometer.unwrap().len() >= taken[0]);
    }
}

#[test]
fn lines_that_came_are_on_disk_when_it_is_killed_though_it_has_not_looked_at_them() {
    let (_dir, path) = folder();
    let text = std::fs::read(path.join("good.csv")).unwrap();
    // It looks every five seconds.
    let mut run = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .current_dir(&path)
        .args(["live", "-", "--out", "session", "--poll", "5"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut input = run.stdin.take().unwrap();
    let kept = || std::fs::read(path.join("session/lines.txt")).unwrap_or_default();
    input.write_all(&text).unwrap();
    let begin = Instant::now();
    while kept().len() < text.len() && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(2));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(kept() == text, "{} of {} bytes", kept().len(), text.len());
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

/// Sends `text` and then its last row again and again, each time 10 ms later, until nobody takes it.
fn send_on(mut input: ChildStdin, text: &str) -> std::io::Result<()> {
    input.write_all(text.as_bytes())?;
    let last = text.lines().last().unwrap();
    let (stamp, reading) = last.split_once(',').unwrap();
    let stamp: f64 = stamp.parse().unwrap();
    for k in 1.. {
        std::thread::sleep(Duration::from_millis(1));
        writeln!(input, "{},{reading}", stamp + 0.01 * f64::from(k))?;
    }
    Ok(())
}

#[test]
fn a_source_that_goes_on_is_calibrated_as_far_as_it_was_recorded() {
    let (_dir, path) = folder();
    let text = std::fs::read_to_string(path.join("good.csv")).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .current_dir(&path)
        .args(["live", "-", "--out", "session", "--poll", "0.02"])
        .args(["--gravity", "9.80665", "--placements", "9"])
        .args(["-o", "cal.json", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let input = run.stdin.take().unwrap();
    let source = text.clone();
    let source = std::thread::spawn(move || send_on(input, &source));
    let run = run.wait_with_output().unwrap();
    let said = stderr(&run);
    assert_eq!(status(&run), 0, "{said}");
    assert!(said.contains("Enough"), "{said}");
    // It was still sending when the program ended.
    assert!(source.join().unwrap().is_err());
    let kept = std::fs::read_to_string(path.join("session/lines.txt")).unwrap();
    assert!(kept.ends_with('\n'));
    let begin = kept.len().min(text.len());
    assert!(
        kept[..begin] == text[..begin],
        "what came is kept as it came"
    );
    // What it calibrated is what it left.
    let again = stillpoint(
        &path,
        &[
            "calibrate",
            "session/lines.txt",
            "--gravity",
            "9.80665",
            "--json",
        ],
    );
    assert_eq!(json(&run), json(&again));
    assert!(path.join("cal.json").is_file());
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

#[test]
fn the_page_shows_the_session_in_a_browser() {
    let Some(chromium) = common::chromium() else {
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    let server = Server::start(phone(0)).unwrap();
    server.phone().tell(live::Instruction::LayDown);
    let mut run = start(dir.path(), &server, "0.05", &["--web"]);
    let said = BufReader::new(run.stderr.take().unwrap());
    let address = said
        .lines()
        .map_while(Result::ok)
        .find_map(|line| Some(line.split_once("http://127.0.0.1:")?.1.to_owned()));
    let address = address.filter(|a| a.contains("in a browser")).unwrap();
    let address = format!("http://127.0.0.1:{}", address.split(' ').next().unwrap());
    let [page, log] = common::browsed(chromium, &address);
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(
        page.contains("class=\"free\"") && page.contains("class=\"edge\""),
        "{page}"
    );
    assert!(
        !log.contains("CONSOLE") && !log.contains("Content Security Policy"),
        "{log}"
    );
}
