//! `discover` from the command line: what it finds, what it writes, what it refuses.

use std::path::{Path, PathBuf};

use calib::recording::to_csv;
use calib::simulate::Spec;

use crate::common::{stderr, stdout, stillpoint};

const HIDDEN: &str = "gyro_g_sensitivity";

/// A folder with the recording of `spec` in `NAME.csv`.
fn folder(name: &str, spec: &Spec) -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().to_owned();
    let mut recording = spec.run().unwrap().recording;
    std::fs::write(path.join(format!("{name}.csv")), to_csv(&mut recording)).unwrap();
    (dir, path)
}

fn hidden() -> (tempfile::TempDir, PathBuf) {
    folder("hidden", &Spec::hand_held(3).with_effect(HIDDEN, 1.0))
}

fn still() -> (tempfile::TempDir, PathBuf) {
    folder("still", &Spec::still(1, 60.0))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_hidden_effect_is_named_added_and_its_gap_shrinks() {
    let (_dir, folder) = hidden();
    let args = [
        "discover",
        "hidden.csv",
        "-o",
        "findings.json",
        "--report",
        "report.html",
        "--plots",
        "plots",
        "-v",
    ];
    let run = stillpoint(&folder, &args);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let said = stdout(&run);
    assert!(
        said.starts_with("With care: the usual sensor model lacks gyro_g_sensitivity."),
        "{said}"
    );
    assert!(
        said.contains("The base models lack gyro_g_sensitivity; it takes the gap"),
        "{said}"
    );
    let text = std::fs::read_to_string(folder.join("findings.json")).unwrap();
    let findings: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(findings["schema"], "stillpoint.findings/1");
    assert_eq!(findings["verdict"], "named");
    assert!(said.contains("°/h rms"), "{said}");
    assert!(said.contains("bias instability"), "{said}");
    // Findings serve as the calibration that they contain.
    let serve = [
        "apply",
        "findings.json",
        "hidden.csv",
        "-o",
        "corrected.csv",
    ];
    let applied = stillpoint(&folder, &serve);
    assert_eq!(applied.status.code(), Some(0), "{}", stderr(&applied));
    for key in [
        "effects",
        "integrity",
        "unexplained",
        "disagreement",
        "calibration",
    ] {
        assert!(findings.get(key).is_some(), "{key}");
    }
    assert_eq!(
        findings["calibration"]["schema"],
        "stillpoint.calibration/1"
    );
    let effect = &findings["effects"][0];
    for key in [
        "name",
        "statistic",
        "dof",
        "p_value",
        "adjusted_p_value",
        "indistinguishable_from",
        "parameters",
        "gap_before",
        "gap_after",
        "held_out_gap_before",
        "held_out_gap_after",
    ] {
        assert!(effect.get(key).is_some(), "{key}");
    }
    assert_eq!(effect["name"], HIDDEN);
    assert_eq!(effect["parameters"].as_array().unwrap().len(), 9);
    let gap = |key: &str| effect[key].as_f64().unwrap();
    for (before, after) in [
        ("gap_before", "gap_after"),
        ("held_out_gap_before", "held_out_gap_after"),
    ] {
        // A rate at rest of 1 mrad/s in means good to 20 µrad/s.
        assert!(gap(before) > 5.0 && gap(after) < 1.5, "{effect}");
    }
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    for words in [
        "What is missing",
        HIDDEN,
        "Verdict",
        "<svg",
        "Not observable",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // The one fixed script, whose hash the policy names.
    assert_eq!(page.matches("<script").count(), 1);
    let plots = names(&folder.join("plots"));
    for plot in ["gap.svg", "residual-1.png", "residual-2.svg"] {
        assert!(plots.iter().any(|p| p == plot), "{plots:?}");
    }
    assert!(plots.iter().all(|p| !p.ends_with(".partial")), "{plots:?}");
}

#[test]
fn a_device_that_lacks_nothing_gets_no_name_and_the_document_is_alone_on_standard_output() {
    let (_dir, folder) = folder("clean", &Spec::hand_held(4));
    let run = stillpoint(&folder, &["discover", "clean.csv", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let findings: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(findings["verdict"], "none");
    assert_eq!(findings["effects"], serde_json::json!([]));
    assert!(findings["unexplained"].is_null());
    let table = stdout(&stillpoint(&folder, &["discover", "clean.csv"]));
    assert!(table.contains("Nothing is missing"), "{table}");
    assert!(
        table.contains("effects could not have shown here"),
        "{table}"
    );
    // What has no temperature column cannot show an effect of temperature.
    let table = stdout(&stillpoint(&folder, &["discover", "clean.csv", "-v"]));
    assert!(table.contains("Not observable") && table.contains("accel_temperature"));
}

#[test]
fn wrong_calls_and_bad_inputs_end_with_their_status() {
    let (_dir, folder) = still();
    std::fs::write(folder.join("noise.json"), "{}").unwrap();
    let cases: [(&[&str], i32, &str); 10] = [
        (&["discover"], 2, "no recording given"),
        (&["discover", "still.csv", "--alpha", "0"], 2, "--alpha"),
        (&["discover", "still.csv", "--alpha", "2"], 2, "--alpha"),
        (&["discover", "still.csv", "--gravity", "1"], 2, "--gravity"),
        (
            &["discover", "still.csv", "--latitude", "-91"],
            2,
            "--latitude -91",
        ),
        (
            &["discover", "still.csv", "-o", "still.csv", "--force"],
            2,
            "is the input",
        ),
        (&["discover", "nowhere.csv"], 3, "nowhere.csv"),
        (
            &["discover", "still.csv", "--validation", "nowhere.csv"],
            3,
            "nowhere.csv",
        ),
        (
            &["discover", "still.csv", "--noise", "noise.json"],
            3,
            "noise.json:1:2",
        ),
        (
            &["discover", "still.csv", "-o", "findings.json"],
            4,
            "static interval",
        ),
    ];
    for (args, status, words) in cases {
        let run = stillpoint(&folder, args);
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(status), "{args:?}: {said}");
        assert!(said.contains(words), "{args:?}: {said}");
        assert!(run.stdout.is_empty(), "{args:?}");
    }
    assert_eq!(names(&folder), ["noise.json", "still.csv"]);
}

#[test]
fn outputs_in_the_way_are_found_before_anything_is_looked_for() {
    let (_dir, folder) = still();
    std::fs::write(folder.join("old.json"), "old").unwrap();
    std::fs::create_dir(folder.join("locked")).unwrap();
    let locked = folder.join("locked");
    let mut permissions = std::fs::metadata(&locked).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&locked, permissions).unwrap();
    // Whoever may write anywhere (root) finds the folder writable.
    let may_write = std::fs::write(locked.join("probe"), "").is_ok();
    let mut cases = vec![
        (["-o", "old.json"], "exists already"),
        (["--report", "old.json"], "exists already"),
        (["-o", "missing/findings.json"], "cannot be written"),
    ];
    if may_write {
        std::fs::remove_file(locked.join("probe")).unwrap();
    } else {
        cases.push((["-o", "locked/findings.json"], "cannot be written"));
    }
    for (args, words) in cases {
        let run = stillpoint(&folder, &[&["discover", "still.csv"], &args[..]].concat());
        assert_eq!(run.status.code(), Some(6), "{args:?}: {}", stderr(&run));
        assert!(stderr(&run).contains(words), "{args:?}: {}", stderr(&run));
    }
    let old = std::fs::read_to_string(folder.join("old.json")).unwrap();
    assert_eq!(old, "old");
}

#[test]
fn another_recording_of_the_device_shows_whether_the_name_holds() {
    let (_dir, folder) = hidden();
    let other = Spec::hand_held(9).run().unwrap();
    std::fs::write(
        folder.join("stranger.csv"),
        to_csv(&mut other.recording.clone()),
    )
    .unwrap();
    let args = [
        "discover",
        "hidden.csv",
        "--validation",
        "stranger.csv",
        "--json",
    ];
    let run = stillpoint(&folder, &args);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let findings: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let validation = &findings["validation"][0];
    assert_eq!(validation["channel"], "static_rate");
    // Another device: the name of this one does not hold there.
    assert!(validation["gap_after"].as_f64().unwrap() > 3.0);
}

#[test]
fn recordings_of_two_devices_are_refused_by_discover_and_by_the_joint_method() {
    let (_dir, folder) = folder("one", &Spec::hand_held(7));
    let mut other = Spec::hand_held(9).run().unwrap().recording;
    std::fs::write(folder.join("two.csv"), to_csv(&mut other)).unwrap();
    for call in [
        &["discover", "one.csv", "two.csv"][..],
        &["calibrate", "one.csv", "two.csv", "--method", "joint"],
    ] {
        let refused = stillpoint(&folder, call);
        assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
        assert!(stderr(&refused).contains("recordings are of different devices"));
    }
}

#[test]
fn late_stamps_named_leave_the_gaps_of_all_channels_on_the_validation_recording() {
    let late = Spec::hand_held(3).with_effect("time_offset", 3.0);
    let (_dir, folder) = folder("late", &late);
    let again = Spec { seed: 4, ..late };
    let mut again = again.run().unwrap().recording;
    std::fs::write(folder.join("again.csv"), to_csv(&mut again)).unwrap();
    let output = stillpoint(
        &folder,
        &[
            "discover",
            "late.csv",
            "--validation",
            "again.csv",
            "--json",
        ],
    );
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["effects"][0]["name"], "time_offset");
    assert_eq!(found["validation"].as_array().unwrap().len(), 3);
}

#[test]
fn a_validation_that_the_fit_has_seen_is_refused_by_path_and_by_content() {
    let (_dir, folder) = hidden();
    let text = std::fs::read_to_string(folder.join("hidden.csv")).unwrap();
    std::fs::write(folder.join("copy.csv"), format!("# a copy\n{text}")).unwrap();
    std::fs::hard_link(folder.join("hidden.csv"), folder.join("link.csv")).unwrap();
    for twin in ["hidden.csv", "link.csv", "copy.csv"] {
        let args = [
            "discover",
            "hidden.csv",
            "--validation",
            twin,
            "-o",
            "f.json",
        ];
        let run = stillpoint(&folder, &args);
        assert_eq!(run.status.code(), Some(2), "{}", stderr(&run));
        let words = [twin, "the same data as hidden.csv", "no proof"];
        assert!(
            words.iter().all(|w| stderr(&run).contains(w)),
            "{}",
            stderr(&run)
        );
    }
    assert_eq!(names(&folder), ["copy.csv", "hidden.csv", "link.csv"]);
}

#[test]
fn units_of_one_type_share_a_name_and_keep_their_sizes() {
    let (_dir, folder) = hidden();
    let other = Spec::hand_held(5).with_effect(HIDDEN, 1.0);
    let mut other = other.run().unwrap().recording;
    std::fs::write(folder.join("other.csv"), to_csv(&mut other)).unwrap();
    let args = ["discover", "hidden.csv", "other.csv", "--units"];
    let run = stillpoint(&folder, &[&args[..], &["-o", "units.json"]].concat());
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let said = stdout(&run).replace('\n', " ");
    assert!(said.starts_with(&format!(
        "The type lacks {HIDDEN}, by the evidence of all 2 units"
    )));
    // Each has coefficients of its own.
    assert!(said.contains("differs from unit to unit"), "{said}");
    assert!(said.contains(&format!(
        "stillpoint calibrate UNIT --method joint --effects {HIDDEN}"
    )));
    let text = std::fs::read_to_string(folder.join("units.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["schema"], "stillpoint.unit_findings/1");
    let sizes = found["shared"][0]["sizes"].as_array().unwrap();
    assert_eq!(sizes.len(), 2);
    for size in sizes {
        assert_eq!(size["parameters"].as_array().unwrap().len(), 9);
        assert!(size["gap_before"].as_f64() > size["gap_after"].as_f64());
    }
    assert_eq!(found["shared"][0]["agreement"]["dof"], 9.0);
}

#[test]
fn a_unit_that_is_given_twice_is_refused() {
    let (_dir, folder) = hidden();
    let text = std::fs::read_to_string(folder.join("hidden.csv")).unwrap();
    std::fs::write(folder.join("copy.csv"), format!("# a copy\n{text}")).unwrap();
    let run = stillpoint(&folder, &["discover", "hidden.csv", "copy.csv", "--units"]);
    assert_eq!(run.status.code(), Some(2), "{}", stderr(&run));
    assert!(
        stderr(&run).contains("would count twice"),
        "{}",
        stderr(&run)
    );
    let one = stillpoint(&folder, &["discover", "hidden.csv", "--units"]);
    assert_eq!(one.status.code(), Some(4), "{}", stderr(&one));
}

#[test]
fn a_device_that_lacks_nothing_has_a_picture_of_what_the_models_leave() {
    let (_dir, folder) = folder("clean", &Spec::hand_held(4));
    let run = stillpoint(&folder, &["discover", "clean.csv", "--plots", "plots"]);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    assert_eq!(
        names(&folder.join("plots")),
        ["remainder.png", "remainder.svg"]
    );
}
