//! `batch` as a line and its engine meet it: shards, resume, merge, bad devices among good, the prior.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use crate::common::{json, stderr, stdout, stillpoint};
use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};
use serde_json::Value;

/// A folder `devices` with `count` short sessions.
fn devices(count: u64) -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("devices");
    std::fs::create_dir(&folder).unwrap();
    for seed in 0..count {
        let mut spec = Spec::hand_held(100 + seed);
        spec.rate = 50.0;
        spec.motion = Motion::HandHeld(HandHeld {
            placements: Some(12),
            initial_rest: Some(5.0),
            ..HandHeld::default()
        });
        let csv = to_csv(&mut spec.run().unwrap().recording);
        std::fs::write(folder.join(format!("d{seed:02}.csv")), csv).unwrap();
    }
    let path = dir.path().to_owned();
    (dir, path)
}

fn bytes(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap()
}

#[test]
fn case_141_shards_merge_to_the_bytes_of_one_run_and_a_rerun_changes_nothing() {
    let (_dir, folder) = devices(5);
    let whole = stillpoint(
        &folder,
        &["batch", "devices", "-o", "one", "--gravity", "9.80665"],
    );
    assert_eq!(whole.status.code(), Some(0), "{}", stderr(&whole));
    assert!(
        stdout(&whole).contains("5 of 5 devices pass"),
        "{}",
        stdout(&whole)
    );
    for shard in ["1/2", "2/2", "1/2"] {
        let call = [
            "batch",
            "devices",
            "-o",
            "two",
            "--gravity",
            "9.80665",
            "--shard",
            shard,
            "--resume",
            "--jobs",
            "1",
        ];
        let run = stillpoint(&folder, &call);
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    }
    for (parts, out) in [("one", "a"), ("two", "b")] {
        let run = stillpoint(
            &folder,
            &[
                "batch", "merge", parts, "-o", out, "--jsonl", "--csv", "--report",
            ],
        );
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    }
    for ending in ["jsonl", "csv", "html"] {
        let [a, b] = ["a", "b"].map(|name| bytes(&folder.join(name).with_extension(ending)));
        assert!(a == b && !a.is_empty(), "{ending}");
    }
    // What calibrate writes, but for nothing.
    let call = [
        "calibrate",
        "devices/d03.csv",
        "--gravity",
        "9.80665",
        "-o",
        "d03.json",
    ];
    assert_eq!(stillpoint(&folder, &call).status.code(), Some(0));
    assert_eq!(
        bytes(&folder.join("d03.json")),
        bytes(&folder.join("one/devices/d03/cal.json"))
    );
    // Again without --resume, or with other options: refused, or another run.
    let run = stillpoint(&folder, &["batch", "devices", "-o", "one", "--json"]);
    assert_eq!(run.status.code(), Some(6));
    assert_eq!(json(&run)["error"]["kind"], "output_exists");
    let call = [
        "batch",
        "devices",
        "-o",
        "two",
        "--shard",
        "2/2",
        "--resume",
        "--gravity",
        "9.8",
    ];
    assert_eq!(stillpoint(&folder, &call).status.code(), Some(0));
    let run = stillpoint(&folder, &["batch", "merge", "two", "-o", "c"]);
    assert_eq!(run.status.code(), Some(3));
    assert!(
        stderr(&run).contains("part-2-of-2.jsonl: this part is of another run"),
        "{}",
        stderr(&run)
    );
    std::fs::remove_file(folder.join("two/part-2-of-2.jsonl")).unwrap();
    let run = stillpoint(&folder, &["batch", "merge", "two", "-o", "c"]);
    assert!(
        stderr(&run).contains("part 2/2 of the batch is missing; run this part with --shard 2/2"),
        "{}",
        stderr(&run)
    );
    assert!(!folder.join("c.jsonl").exists());
}

#[test]
fn bad_devices_have_their_reasons_and_the_others_are_as_without_them() {
    let (_dir, folder) = devices(3);
    let good = stillpoint(&folder, &["batch", "devices", "-o", "good"]);
    assert_eq!(good.status.code(), Some(0), "{}", stderr(&good));
    let own = std::fs::read_to_string(folder.join("devices/d00.csv")).unwrap();
    let bad =
        |name: &str, text: &str| std::fs::write(folder.join("devices").join(name), text).unwrap();
    bad("empty.csv", "");
    bad("foreign.csv", "name,colour\napple,red\n");
    bad("truncated.csv", &own[..own.len() / 12]);
    bad(
        "nan.csv",
        &own.replacen("\n0.", "\nnan0.", 1).replace(",0.0", ",NaN"),
    );
    let kilo = |line: &str| match line.split_once(',') {
        Some((t, cells)) if t.parse::<f64>().is_ok() => {
            let cells = cells
                .split(',')
                .map(|c| format!("{}", c.parse::<f64>().unwrap_or(0.0) * 1000.0));
            format!("{t},{}\n", cells.collect::<Vec<_>>().join(","))
        }
        _ => format!("{line}\n"),
    };
    bad("units.csv", &own.lines().map(kilo).collect::<String>());
    let run = stillpoint(&folder, &["batch", "devices", "-o", "out", "--json"]);
    assert_eq!(run.status.code(), Some(1));
    let records = json(&run);
    let status = |id: &str| {
        let found = records
            .as_array()
            .unwrap()
            .iter()
            .find(|r| r["id"] == id)
            .unwrap();
        (
            found["status"].as_str().unwrap().to_owned(),
            found["reasons"][0].as_str().unwrap_or("").to_owned(),
        )
    };
    assert_eq!(status("empty").0, "input");
    assert!(status("empty").1.contains("empty"), "{:?}", status("empty"));
    assert_eq!(status("foreign").0, "input");
    assert_eq!(status("nan").0, "input");
    assert_eq!(status("truncated").0, "not_enough");
    for id in ["d00", "d01", "d02"] {
        assert_eq!(status(id).0, "pass");
        let cal = format!("devices/{id}/cal.json");
        assert_eq!(
            bytes(&folder.join("good").join(&cal)),
            bytes(&folder.join("out").join(&cal))
        );
    }
    let run = stillpoint(&folder, &["batch", "merge", "out", "-o", "all", "--json"]);
    assert_eq!(
        json(&run)["passed"].as_u64().unwrap() + 4,
        json(&run)["devices"].as_u64().unwrap() - u64::from(status("units").0 != "pass")
    );
}

#[test]
fn case_133_a_device_called_like_a_formula_stays_a_word_in_the_table() {
    let (_dir, folder) = devices(1);
    let formula = "=cmd|' 'calc'!A0";
    let from = folder.join("devices/d00.csv");
    std::fs::rename(from, folder.join(format!("devices/{formula}.csv"))).unwrap();
    let run = stillpoint(&folder, &["batch", "devices", "-o", "out"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let merge = [
        "batch", "merge", "out", "-o", "all", "--csv", "--jsonl", "--report",
    ];
    let run = stillpoint(&folder, &merge);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let table = std::fs::read_to_string(folder.join("all.csv")).unwrap();
    let id = table.lines().nth(1).unwrap();
    assert!(id.starts_with(&format!("'{formula},")), "{id}");
    // What programs read has the name as it is.
    let lines = std::fs::read_to_string(folder.join("all.jsonl")).unwrap();
    let record: Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
    assert_eq!(record["id"], formula);
}

/// Kills by SIGKILL; `STILLPOINT_KILLS=50` is the large version.
fn kills() -> u64 {
    let asked = std::env::var("STILLPOINT_KILLS").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(8)
}

#[test]
fn case_141_a_batch_killed_at_any_time_resumes_to_the_same_bytes() {
    let (_dir, folder) = devices(4);
    let begin = Instant::now();
    assert_eq!(
        stillpoint(&folder, &["batch", "devices", "-o", "calm"])
            .status
            .code(),
        Some(0)
    );
    let length = begin.elapsed();
    let same = || {
        let ids = ["d00", "d01", "d02", "d03"].map(|id| format!("devices/{id}/cal.json"));
        for file in ids.iter().map(String::as_str).chain(["part-1-of-1.jsonl"]) {
            assert_eq!(
                bytes(&folder.join("calm").join(file)),
                bytes(&folder.join("killed").join(file)),
                "{file}"
            );
        }
        std::fs::remove_dir_all(folder.join("killed")).unwrap();
    };
    let resume = ["batch", "devices", "-o", "killed", "--resume"];
    let (mut killed, mut random) = (0, 1_u64);
    while killed < kills() {
        let mut child = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
            .current_dir(&folder)
            .args(resume)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // At any time of a run (Knuth's generator).
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(length.mul_f64((random >> 32) as f64 / 2f64.powi(32)));
        child.kill().unwrap();
        match child.wait().unwrap().code() {
            None => killed += 1,
            Some(code) => {
                assert_eq!(code, 0);
                same();
            }
        }
    }
    let run = stillpoint(&folder, &resume);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    same();
}

#[test]
fn a_prior_of_the_type_is_used_and_says_what_it_gave() {
    let (_dir, folder) = devices(1);
    let call = [
        "calibrate",
        "devices/d00.csv",
        "--gravity",
        "9.80665",
        "-o",
        "cal.json",
    ];
    assert_eq!(stillpoint(&folder, &call).status.code(), Some(0));
    let cal: Value = serde_json::from_slice(&bytes(&folder.join("cal.json"))).unwrap();
    let names: Vec<&str> = cal["parameters"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_str().unwrap())
        .collect();
    // Calibrations that scatter by one standard error about this one: a type that spreads by nothing.
    for k in 0..120_usize {
        let mut own = cal.clone();
        for (p, name) in names.iter().enumerate() {
            let std = cal["covariance"][p][p].as_f64().unwrap().sqrt();
            let axis = ["x", "y", "z"].iter().position(|a| name.ends_with(a));
            let (Some(axis), true) = (axis, name.starts_with("accel.b_")) else {
                continue;
            };
            let z = ((k * (7 + 2 * axis)) % 121) as f64 / 60.5 - 1.0;
            let value = cal["accelerometer"]["bias"][axis].as_f64().unwrap() + 1.7 * z * std;
            own["accelerometer"]["bias"][axis] = value.into();
        }
        own["numbers_sha256"] = Value::Null;
        // Another session: what is of the same samples counts once.
        own["inputs"][0]["samples_sha256"] = format!("{k:064x}").into();
        std::fs::write(folder.join(format!("c{k}.json")), own.to_string()).unwrap();
    }
    let files: Vec<String> = (0..120).map(|k| format!("c{k}.json")).collect();
    let mut call = vec!["batch", "prior", "-o", "prior.json"];
    call.extend(files.iter().map(String::as_str));
    let run = stillpoint(&folder, &call);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let call = [
        "calibrate",
        "devices/d00.csv",
        "--gravity",
        "9.80665",
        "--prior",
        "prior.json",
        "-o",
        "with.json",
        "-v",
    ];
    let run = stillpoint(&folder, &call);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    assert!(
        stdout(&run).contains("the device belongs to the type"),
        "{}",
        stdout(&run)
    );
    let with: Value = serde_json::from_slice(&bytes(&folder.join("with.json"))).unwrap();
    let error = |cal: &Value| cal["accelerometer"]["bias_std"][0].as_f64().unwrap();
    assert!(
        // A spread that 120 devices tell is widened by 119/97.
        error(&with) < 0.55 * error(&cal),
        "{} of {}",
        error(&with),
        error(&cal)
    );
    assert!(with["prior"]["parameters"][0]["by_prior"].as_f64().unwrap() > 0.5);
}
