//! The command line as scripts meet it: exit statuses, files left whole, one JSON document.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use calib::recording::{stream_to_csv, to_csv};
use calib::simulate::{HandHeld, Motion, Session, Spec};

use crate::common::{json, stderr, stillpoint};

fn status(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn session() -> Session {
    let mut spec = Spec::hand_held(11);
    let motion = HandHeld {
        placements: Some(26),
        initial_rest: Some(50.0),
        ..HandHeld::default()
    };
    spec.motion = Motion::HandHeld(motion);
    spec.run().unwrap()
}

/// A folder with `good.csv`.
fn folder() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().to_owned();
    std::fs::write(path.join("good.csv"), to_csv(&mut session().recording)).unwrap();
    (dir, path)
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_recording_becomes_a_calibration_that_corrects_it() {
    let (_dir, folder) = folder();
    let run = stillpoint(&folder, &["calibrate", "good.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    assert!(String::from_utf8_lossy(&run.stdout).contains("scale, ppm"));
    let run = stillpoint(
        &folder,
        &["apply", "cal.json", "good.csv", "-o", "corrected.csv"],
    );
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let run = stillpoint(&folder, &["evaluate", "corrected.csv", "--json"]);
    let misfit = &json(&run)[0]["misfit"];
    assert!(misfit["modulus_rms"].as_f64().unwrap() < 2e-3, "{misfit}");
    assert_eq!(files(&folder), ["cal.json", "corrected.csv", "good.csv"]);
}

#[test]
fn json_is_one_document_of_the_schema_and_the_same_bytes_every_time() {
    let (_dir, folder) = folder();
    let runs: Vec<Output> = (0..2)
        .map(|_| stillpoint(&folder, &["calibrate", "good.csv", "--json"]))
        .collect();
    assert_eq!(runs[0].stdout, runs[1].stdout);
    let document = json(&runs[0]);
    assert_eq!(document["schema"], "stillpoint.calibration/1");
    assert!(document["accelerometer"]["T_std"][1][0].is_null());
    assert!(document["accelerometer"]["T_std"][0][1].as_f64().unwrap() > 0.0);
    assert_eq!(document["accelerometer"]["rank"], 9);
    let names = document["parameters"].as_array().unwrap().len();
    let rows = document["covariance"].as_array().unwrap();
    assert_eq!(rows.len(), names);
    assert!(
        rows.iter()
            .all(|row| row.as_array().unwrap().len() == names)
    );
}

#[test]
fn an_existing_file_is_kept_unless_forced() {
    let (_dir, folder) = folder();
    std::fs::write(folder.join("cal.json"), "precious").unwrap();
    let run = stillpoint(&folder, &["calibrate", "good.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 6);
    assert!(stderr(&run).contains("--force"));
    assert_eq!(
        std::fs::read_to_string(folder.join("cal.json")).unwrap(),
        "precious"
    );
    let run = stillpoint(
        &folder,
        &["calibrate", "good.csv", "-o", "cal.json", "--force"],
    );
    assert_eq!(status(&run), 0);
    assert!(
        std::fs::read_to_string(folder.join("cal.json"))
            .unwrap()
            .contains("schema")
    );
}

#[test]
fn a_failed_run_leaves_no_trace() {
    let (_dir, folder) = folder();
    std::fs::write(
        folder.join("bad.csv"),
        "t,ax,ay,az,gx,gy,gz\n0,1,2,3,4,5,x\n",
    )
    .unwrap();
    let run = stillpoint(&folder, &["calibrate", "bad.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 3);
    assert!(stderr(&run).contains("bad.csv:2:"), "{}", stderr(&run));
    assert_eq!(files(&folder), ["bad.csv", "good.csv"]);
}

#[test]
fn an_output_that_is_an_input_is_refused_through_links_too() {
    let (_dir, folder) = folder();
    let before = std::fs::read(folder.join("good.csv")).unwrap();
    std::fs::hard_link(folder.join("good.csv"), folder.join("twin.csv")).unwrap();
    for target in ["good.csv", "twin.csv"] {
        let run = stillpoint(&folder, &["calibrate", "good.csv", "-o", target, "--force"]);
        assert_eq!(status(&run), 2, "{}", stderr(&run));
    }
    assert_eq!(std::fs::read(folder.join("good.csv")).unwrap(), before);
}

#[test]
fn a_folder_or_a_device_is_no_output() {
    let (_dir, folder) = folder();
    for target in [".", "missing/cal.json"] {
        let run = stillpoint(&folder, &["calibrate", "good.csv", "-o", target]);
        assert_eq!(status(&run), 6, "{target}: {}", stderr(&run));
    }
    #[cfg(unix)]
    {
        let run = stillpoint(
            &folder,
            &["calibrate", "good.csv", "-o", "/dev/null", "--force"],
        );
        assert_eq!(status(&run), 6);
    }
    assert_eq!(files(&folder), ["good.csv"]);
}

#[test]
fn wrong_calls_say_what_is_wrong() {
    let (_dir, folder) = folder();
    let cases: [(&[&str], &str); 7] = [
        (&["calibrate"], "no recording"),
        (
            &["calibrate", "good.csv", "--gravity", "98.1"],
            "--gravity 98.1",
        ),
        (
            &["calibrate", "good.csv", "--gravity", "1e300"],
            "--gravity 1e300:",
        ),
        (
            &["segment", "good.csv", "--columns", "ax=2,ay=2"],
            "both ax and ay",
        ),
        (
            &["calibrate", "good.csv", "--effects", "gyro_gsens"],
            "not in the catalogue",
        ),
        (
            &["calibrate", "good.csv", "--multiplier=-1"],
            "--multiplier",
        ),
        (
            &[
                "calibrate",
                "good.csv",
                "--effects",
                "gyro_delay",
                "--nominal-rate",
                "0",
            ],
            "rate",
        ),
    ];
    for (args, words) in cases {
        let run = stillpoint(&folder, args);
        assert_eq!(status(&run), 2, "{args:?}: {}", stderr(&run));
        assert!(stderr(&run).contains(words), "{args:?}: {}", stderr(&run));
    }
}

#[test]
fn a_calibration_that_cannot_be_used_is_refused_by_entry() {
    let (_dir, folder) = folder();
    let good = json(&stillpoint(&folder, &["calibrate", "good.csv", "--json"]));
    let broken = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut value = good.clone();
        change(&mut value);
        value.to_string()
    };
    let cases = [
        ("{".to_owned(), "cal.json:1:"),
        ("{}".to_owned(), "schema"),
        ("t,ax,ay,az\n0,0,0,9.8\n".to_owned(), "swapped"),
        (broken(&|v| v["gravity"] = (-5).into()), "gravity: is -5"),
        (
            broken(&|v| v["covariance"] = serde_json::json!([[1]])),
            "covariance: 1 rows",
        ),
        (
            broken(&|v| v["accelerometer"]["T"][0] = serde_json::json!([0, 0, 0])),
            "no inverse",
        ),
        (
            broken(&|v| v["gyroscope"]["model"] = "a = T (A - b)".into()),
            "swapped",
        ),
        (
            broken(&|v| {
                v["effects"] = serde_json::json!([{"name": "warp_drive", "parameters": []}]);
            }),
            "warp_drive",
        ),
    ];
    for (text, words) in cases {
        std::fs::write(folder.join("cal.json"), text).unwrap();
        let run = stillpoint(&folder, &["apply", "cal.json", "good.csv"]);
        assert_eq!(status(&run), 3, "{}", stderr(&run));
        assert!(stderr(&run).contains(words), "{words}: {}", stderr(&run));
    }
}

#[test]
fn a_file_of_a_newer_version_is_a_wrong_call_with_both_versions() {
    let (_dir, folder) = folder();
    let good = stillpoint(&folder, &["calibrate", "good.csv", "--json"]);
    let mut value = json(&good);
    value["schema"] = "stillpoint.calibration/9".into();
    std::fs::write(folder.join("cal.json"), value.to_string()).unwrap();
    let run = stillpoint(&folder, &["apply", "cal.json", "good.csv"]);
    assert_eq!(status(&run), 2, "{}", stderr(&run));
    let message = stderr(&run);
    assert!(
        message.contains("calibration/9") && message.contains("calibration/1"),
        "{message}"
    );
}

#[test]
fn too_little_information_is_status_four() {
    let (_dir, folder) = folder();
    let still = Spec::still(1, 60.0).run().unwrap();
    std::fs::write(
        folder.join("still.csv"),
        to_csv(&mut still.recording.clone()),
    )
    .unwrap();
    let run = stillpoint(&folder, &["calibrate", "still.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 4);
    assert!(stderr(&run).contains("all static"), "{}", stderr(&run));
    assert_eq!(files(&folder), ["good.csv", "still.csv"]);
}

#[test]
fn a_flipped_gyroscope_axis_fails_the_gate_and_marks_the_result() {
    let (_dir, folder) = folder();
    let mut recording = session().recording;
    for w in &mut recording.gyroscope.as_mut().unwrap().values {
        w.y = -w.y;
    }
    std::fs::write(folder.join("flipped.csv"), to_csv(&mut recording)).unwrap();
    let run = stillpoint(&folder, &["calibrate", "flipped.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 1, "{}", stderr(&run));
    assert!(stderr(&run).contains("y is flipped"), "{}", stderr(&run));
    let text = std::fs::read_to_string(folder.join("cal.json")).unwrap();
    assert!(text.contains("failed_gates"));
}

#[test]
fn a_time_base_that_is_wrong_by_two_fails_the_gate() {
    let (_dir, folder) = folder();
    for factor in [0.5, 2.0] {
        let mut recording = session().recording;
        for stream in [&mut recording.accelerometer, &mut recording.gyroscope] {
            stream
                .as_mut()
                .unwrap()
                .t
                .iter_mut()
                .for_each(|t| *t *= factor);
        }
        std::fs::write(folder.join("slow.csv"), to_csv(&mut recording)).unwrap();
        let run = stillpoint(&folder, &["calibrate", "slow.csv"]);
        assert_eq!(status(&run), 1, "{factor}: {}", stderr(&run));
        assert!(
            stderr(&run).contains("its unit or its sampling rate is wrong"),
            "{}",
            stderr(&run)
        );
    }
}

#[test]
fn two_sensors_on_clocks_of_their_own_keep_them() {
    let (_dir, folder) = folder();
    let recording = session().recording;
    std::fs::create_dir(folder.join("phone")).unwrap();
    let acc = stream_to_csv(recording.accelerometer.as_ref().unwrap(), "t,ax,ay,az", 0);
    let mut gyroscope = recording.gyroscope.clone().unwrap();
    for t in &mut gyroscope.t {
        *t += 0.0037;
    }
    std::fs::write(folder.join("phone/acc.csv"), acc).unwrap();
    std::fs::write(
        folder.join("phone/gyro.csv"),
        stream_to_csv(&gyroscope, "t,gx,gy,gz", 0),
    )
    .unwrap();
    let run = stillpoint(&folder, &["calibrate", "phone", "-o", "cal.json"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let run = stillpoint(&folder, &["apply", "cal.json", "phone", "-o", "corrected"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    assert_eq!(files(&folder.join("corrected")), ["acc.csv", "gyro.csv"]);
    let run = stillpoint(&folder, &["apply", "cal.json", "phone", "-o", "one.csv"]);
    assert_eq!(status(&run), 0);
    assert!(stderr(&run).contains("interpolates"));
}

#[test]
fn raw_counts_in_two_text_files_need_no_first_guess() {
    let (_dir, folder) = folder();
    let mut spec = Spec::hand_held(12);
    for (sensor, step) in [(&mut spec.accelerometer, 6e-4), (&mut spec.gyroscope, 2e-4)] {
        sensor.counts = true;
        sensor.step = step;
    }
    let session = spec.run().unwrap();
    let text = |stream: &calib::recording::Stream| {
        let rows = stream.t.iter().zip(&stream.values);
        rows.map(|(t, v)| format!("   {t:.7e}   {:.7e}   {:.7e}   {:.7e}\n", v.x, v.y, v.z))
            .collect::<String>()
    };
    let recording = &session.recording;
    std::fs::write(
        folder.join("acc.mat"),
        text(recording.accelerometer.as_ref().unwrap()),
    )
    .unwrap();
    std::fs::write(
        folder.join("gyro.mat"),
        text(recording.gyroscope.as_ref().unwrap()),
    )
    .unwrap();
    let args = [
        "calibrate",
        "--accel-file",
        "acc.mat",
        "--gyro-file",
        "gyro.mat",
        "--json",
    ];
    let run = stillpoint(&folder, &args);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let document = json(&run);
    let found = document["accelerometer"]["T"][0][0].as_f64().unwrap();
    let truth = session.truth.get("accel.s_x").unwrap();
    assert!((found / truth - 1.0).abs() < 5e-4, "{found} {truth}");
    let found = document["gyroscope"]["T"][2][2].as_f64().unwrap();
    let truth = session.truth.get("gyro.s_z").unwrap();
    assert!((found / truth - 1.0).abs() < 1e-3, "{found} {truth}");
}

#[test]
fn demo_discovers_what_it_hid_and_shows_truth_beside_estimate() {
    let (_dir, folder) = folder();
    let run = stillpoint(&folder, &["demo", "-v", "--out", "demo"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(
        text.starts_with(
            "The hidden effect is found: gyro_g_sensitivity. All data here are simulated."
        ),
        "{text}"
    );
    assert!(
        text.contains("lack gyro_g_sensitivity;")
            && text.contains("accel.s_x")
            && text.contains("gyro_g_sensitivity.zz"),
        "{text}"
    );
    let page = std::fs::read_to_string(folder.join("demo/report.html")).unwrap();
    assert!(page.contains("truth beside estimate") && page.contains("are simulated"));
    assert_eq!(
        files(&folder.join("demo")),
        ["cal.json", "findings.json", "recording.csv", "report.html"]
    );
}

#[test]
fn a_reader_that_closes_the_pipe_is_no_error() {
    let (_dir, folder) = folder();
    let mut child = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .current_dir(&folder)
        .args(["segment", "good.csv"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(status(&output), 0);
    assert!(!stderr(&output).contains("panicked"), "{}", stderr(&output));
}

#[test]
fn standard_input_is_a_recording() {
    let (_dir, folder) = folder();
    let output = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .args(["segment", "-", "--json"])
        .stdin(std::fs::File::open(folder.join("good.csv")).unwrap())
        .output()
        .unwrap();
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(json(&output)["static"].as_array().unwrap().len(), 26);
}
