//! `--limits`: pass or fail by a file, and what fails without one.

use crate::common::{folder, json, stderr, stdout, stillpoint};
use serde_json::Value;

#[test]
fn a_limit_that_is_not_kept_is_exit_1_with_the_reason_and_the_outputs_are_marked() {
    let (_dir, folder) = folder();
    let limits = "required = [\"accelerometer\", \"gyroscope\"]\n[accelerometer]\nresidual_mm_s2 = 50.0\nscale = 1e-9\n";
    std::fs::write(folder.join("l.toml"), limits).unwrap();
    let call = [
        "calibrate",
        "good.csv",
        "--limits",
        "l.toml",
        "--gravity",
        "9.80665",
        "-o",
        "cal.json",
    ];
    let run = stillpoint(&folder, &call);
    assert_eq!(run.status.code(), Some(1), "{}", stderr(&run));
    assert!(
        stderr(&run).contains("limit: accelerometer.scale (standard error) is "),
        "{}",
        stderr(&run)
    );
    let first = stdout(&run);
    assert!(
        first.starts_with("Not to be used: accelerometer.scale (standard error) is "),
        "{first}"
    );
    assert!(first.contains("1 of 4 fail"), "{first}");
    assert!(
        first
            .lines()
            .take_while(|l| !l.is_empty())
            .all(|l| l.chars().count() <= 80),
        "{first}"
    );
    let cal: Value =
        serde_json::from_slice(&std::fs::read(folder.join("cal.json")).unwrap()).unwrap();
    let lines = cal["limits"].as_array().unwrap();
    let failed: Vec<&Value> = lines.iter().filter(|l| l["pass"] == false).collect();
    assert_eq!(failed.len(), 1);
    assert_eq!(failed[0]["name"], "accelerometer.scale");
    assert!(failed[0]["value"].as_f64().unwrap() > 1e-9 && failed[0]["limit"] == 1e-9);
    // The calibration of that file on the recording: residuals are judged, errors are the file's.
    let call = [
        "evaluate",
        "good.csv",
        "--calibration",
        "a=cal.json",
        "--limits",
        "l.toml",
        "--json",
    ];
    let run = stillpoint(&folder, &call);
    assert_eq!(run.status.code(), Some(1), "{}", stderr(&run));
    assert_eq!(
        json(&run)[1]["limits"][2]["name"],
        "accelerometer.residual_mm_s2"
    );
}

#[test]
fn a_key_that_is_none_is_a_wrong_call_that_names_the_nearest() {
    let (_dir, folder) = folder();
    std::fs::write(folder.join("l.toml"), "[gyroscope]\nresidual_dge = 1.0\n").unwrap();
    let run = stillpoint(
        &folder,
        &["calibrate", "good.csv", "--limits", "l.toml", "--json"],
    );
    assert_eq!(run.status.code(), Some(2));
    let error = &json(&run)["error"];
    assert_eq!((&error["line"], &error["column"]), (&2.into(), &1.into()));
    let message = error["message"].as_str().unwrap();
    assert!(
        message.ends_with("did you mean `residual_deg`?"),
        "{message}"
    );
}
