//! A sensor that was recorded and could not be calibrated never looks as if it were.

use std::path::Path;

use crate::common::{files, json, status, stderr, stdout, stillpoint};
use calib::intervals::{Detector, segment};
use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};
use calib::{Recording, recording::Stream};
use serde_json::Value;

/// A session of 14 placements.
fn session(seed: u64) -> Recording {
    let mut spec = Spec::hand_held(seed);
    spec.rate = 50.0;
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(14),
        initial_rest: Some(5.0),
        ..HandHeld::default()
    });
    spec.run().unwrap().recording
}

/// The recording without the samples of half a second in the middle of all turns but the first `kept`.
fn with_gaps(mut recording: Recording, kept: usize) -> Recording {
    let cut = segment(&recording, &Detector::default()).unwrap();
    let turns = cut.turns.iter().skip(kept);
    let gaps: Vec<f64> = turns
        .map(|turn| 0.5 * (turn.span.from + turn.span.to))
        .collect();
    let is_lost = |t: f64| gaps.iter().any(|gap| (t - gap).abs() < 0.25);
    let without = |stream: &mut Stream| {
        let samples = stream.t.iter().copied().zip(stream.values.iter().copied());
        let (t, values) = samples.filter(|(t, _)| !is_lost(*t)).unzip();
        *stream = Stream { t, values };
    };
    without(recording.accelerometer.as_mut().unwrap());
    without(recording.gyroscope.as_mut().unwrap());
    recording
}

/// The recording with a gyroscope that reads no more than a little.
fn clipped(mut recording: Recording) -> Recording {
    let values = &mut recording.gyroscope.as_mut().unwrap().values;
    values
        .iter_mut()
        .for_each(|w| *w = w.map(|v| v.clamp(-0.3, 0.3)));
    recording
}

fn write(folder: &Path, name: &str, recording: &Recording) {
    std::fs::write(folder.join(name), to_csv(&mut recording.clone())).unwrap();
}

fn read(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn without_a_usable_turn_the_accelerometer_is_written_and_the_gyroscope_is_marked_by_every_method()
{
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    write(folder, "gaps.csv", &with_gaps(session(3), 0));
    write(folder, "clipped.csv", &clipped(session(4)));
    for (name, words) in [
        ("gaps.csv", "with samples missing"),
        ("clipped.csv", "faster than the gyroscope can read"),
    ] {
        for method in ["auto", "joint", "stepwise"] {
            let call = [
                "calibrate",
                name,
                "--method",
                method,
                "-o",
                "cal.json",
                "--force",
                "--gravity",
                "9.80665",
                "--json",
            ];
            let run = stillpoint(folder, &call);
            assert_eq!(status(&run), 4, "{}", stderr(&run));
            let said = stderr(&run);
            assert!(
                said.contains("the gyroscope is not calibrated: none of") && said.contains(words),
                "{said}"
            );
            for written in [read(&folder.join("cal.json")), json(&run)] {
                let gyroscope = &written["gyroscope"];
                assert_eq!(gyroscope["status"], "not_calibrated");
                assert_eq!(gyroscope["reason"], "no_usable_turn");
                assert!(gyroscope["T"].is_null() && gyroscope["bias"].is_array());
                assert!(written["accelerometer"]["T"].is_array());
            }
        }
    }
}

#[test]
fn too_few_usable_turns_are_marked_with_what_is_missing() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    write(folder, "few.csv", &with_gaps(session(5), 2));
    let run = stillpoint(folder, &["calibrate", "few.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 4, "{}", stderr(&run));
    assert!(
        stderr(&run).contains("turns can be used, and 7 or more are needed"),
        "{}",
        stderr(&run)
    );
    assert_eq!(
        read(&folder.join("cal.json"))["gyroscope"]["reason"],
        "too_few_turns"
    );
}

#[test]
fn whoever_asks_for_the_accelerometer_alone_gets_it() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    write(folder, "gaps.csv", &with_gaps(session(3), 0));
    let call = [
        "calibrate",
        "gaps.csv",
        "--sensor",
        "accelerometer",
        "-o",
        "cal.json",
    ];
    let run = stillpoint(folder, &call);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let written = read(&folder.join("cal.json"));
    assert!(written["gyroscope"].is_null() && written["accelerometer"]["T"].is_array());
    let useless = [
        "calibrate",
        "gaps.csv",
        "--sensor",
        "accelerometer",
        "--effects",
        "gyro_g_sensitivity",
    ];
    assert_eq!(status(&stillpoint(folder, &useless)), 2);
}

#[test]
fn what_needs_the_missing_sensor_says_so_or_refuses() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    write(folder, "gaps.csv", &with_gaps(session(3), 0));
    stillpoint(folder, &["calibrate", "gaps.csv", "-o", "cal.json"]);
    let said = "the gyroscope is not calibrated";
    for call in [
        &["apply", "cal.json", "gaps.csv", "-o", "corrected.csv"][..],
        &["export", "cal.json", "--to", "ros2", "-o", "out.yaml"],
        &["export", "cal.json", "--to", "c", "-o", "out.h"],
        &["export", "cal.json", "--to", "toml", "-o", "out.toml"],
        &["export", "cal.json", "--to", "npz", "-o", "out.npz"],
    ] {
        let run = stillpoint(folder, call);
        let all = stderr(&run);
        let refused = status(&run) != 0 && all.contains("gyroscope");
        assert!(refused || all.contains(said), "{call:?}: {all}");
    }
    for call in [
        &["export", "cal.json", "--to", "kalibr", "-o", "kalibr.yaml"][..],
        &["bias", "cal.json", "gaps.csv"],
    ] {
        let run = stillpoint(folder, call);
        assert_ne!(status(&run), 0, "{call:?}: {}", stdout(&run));
    }
}

#[test]
fn a_batch_counts_the_device_as_one_without_enough() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    std::fs::create_dir(folder.join("devices")).unwrap();
    write(&folder.join("devices"), "good.csv", &session(3));
    write(
        &folder.join("devices"),
        "gaps.csv",
        &with_gaps(session(3), 0),
    );
    let run = stillpoint(
        folder,
        &["batch", "devices", "-o", "out", "--gravity", "9.80665"],
    );
    assert_ne!(status(&run), 0);
    assert!(
        stdout(&run).contains("1 of 2 devices pass"),
        "{}",
        stdout(&run)
    );
    stillpoint(
        folder,
        &["batch", "merge", "out", "-o", "merged", "--jsonl"],
    );
    let lines = std::fs::read_to_string(folder.join("merged.jsonl")).unwrap();
    let marked = lines
        .lines()
        .find(|line| line.contains("\"gaps\""))
        .unwrap();
    let record: Value = serde_json::from_str(marked).unwrap();
    assert_eq!(record["status"], "not_enough");
    assert_eq!(record["exit"], 4);
    assert!(
        record["reasons"][0]
            .as_str()
            .unwrap()
            .contains("not calibrated")
    );
    assert!(files(folder).contains(&"merged.jsonl".into()));
}
