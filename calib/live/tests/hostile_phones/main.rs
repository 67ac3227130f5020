//! Phones that mean no good, or are broken: the session goes on or ends with its reason, soon and in one line.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod kinds;
mod server;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use calib::recording::ReadOptions;
use kinds::{KINDS, Kind, body};
use server::Server;
use stillpoint_live::{Aim, Error, Event, Opening, Phyphox, Session, Source, Waits};

const WAITS: Waits = Waits {
    answer: Duration::from_millis(300),
    export: Duration::from_millis(600),
};
/// The caller's clock goes on by this between polls, so that patience ends.
const STEP: Duration = Duration::from_secs(31);
const POLLS: u32 = 9;
/// No kind takes longer, with eight others on two cores.
const BUDGET: Duration = Duration::from_secs(20);

/// A session with such a phone to its end: what ended it, and everything that was said.
fn held(address: &str, folder: &Path) -> (Option<Error>, Vec<String>) {
    let how = Opening {
        folder: folder.to_owned(),
        read: ReadOptions::default(),
        baud: 0,
        patience: Duration::from_secs(180),
        waits: WAITS,
    };
    let mut said = Vec::new();
    let mut phone = match Phyphox::connect(address, &how) {
        Ok(phone) => phone,
        Err(error) => return (Some(error), said),
    };
    let mut session = Session::new(Aim::default());
    for k in 0..POLLS {
        match phone.poll(STEP * k) {
            Ok(batch) => {
                for event in &batch.events {
                    match event {
                        Event::Connected { name } => said.push(name.clone()),
                        Event::Reconnecting { cause, .. } => said.push(cause.clone()),
                        _ => {}
                    }
                }
                session.take(&batch);
            }
            Err(error) => return (Some(error), said),
        }
    }
    match phone.finish() {
        Ok(finished) => said.extend(finished.fallback),
        Err(error) => return (Some(error), said),
    }
    (None, said)
}

fn check((name, place, how): Kind) {
    let server = Server::start(place, how);
    let folder = tempfile::tempdir().unwrap();
    let begin = Instant::now();
    let (error, said) = held(&server.address, folder.path());
    let took = begin.elapsed();
    assert!(took < BUDGET, "{place} {name}: {took:?}");
    for text in said.into_iter().chain(error.map(|e| e.to_string())) {
        let is_short = text.chars().count() < 1000 && !text.chars().any(char::is_control);
        assert!(is_short, "{place} {name}: {text:?}");
    }
    for file in ["acc.csv", "gyro.csv"] {
        let path = folder.path().join("received").join(file);
        for line in std::fs::read_to_string(path)
            .unwrap_or_default()
            .lines()
            .skip(1)
        {
            let mut numbers = line.split(',').map(|cell| cell.parse::<f64>().unwrap());
            assert!(numbers.all(|x| x.abs() < 1e8), "{place} {name}: {line}");
        }
    }
}

#[test]
fn whatever_a_phone_answers_the_session_goes_on_or_ends_with_its_reason() {
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                while let Some(kind) = KINDS.get(next.fetch_add(1, Ordering::SeqCst)) {
                    check(*kind);
                }
            });
        }
    });
}

#[test]
fn an_ordinary_phone_is_no_hostile_one() {
    let server = Server::start("", |_| body(""));
    let folder = tempfile::tempdir().unwrap();
    let (error, said) = held(&server.address, folder.path());
    assert!(error.is_none(), "{error:?} {said:?}");
    let text = std::fs::read_to_string(folder.path().join("received/acc.csv")).unwrap();
    assert!(text.lines().count() > 50, "{text}");
}

#[test]
fn a_time_or_a_reading_that_no_phone_has_is_named_as_the_reason() {
    let expected = [
        ("1e300 s", "a time of 1e300 s"),
        ("before the beginning", "a time of -5e1 s"),
        ("1e308 m/s²", "1e308, as no sensor gives"),
        ("a session every time", "restarted"),
    ];
    for (name, words) in expected {
        let kind = KINDS
            .iter()
            .find(|(kind, place, _)| *kind == name && *place == "/get");
        let (_, place, how) = kind.unwrap();
        let server = Server::start(place, *how);
        let folder = tempfile::tempdir().unwrap();
        let (error, mut said) = held(&server.address, folder.path());
        said.extend(error.map(|e| e.to_string()));
        let restarted = folder.path().join("received/before_1").exists();
        said.extend(restarted.then(|| "restarted".to_owned()));
        assert!(
            said.iter().any(|text| text.contains(words)),
            "{name}: {said:?}"
        );
    }
}
