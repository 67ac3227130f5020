//! Effects that a user defines in a file: simulated, listed, calibrated, applied.

use crate::common::{json, stillpoint};

/// Rates about two axes leak into the third.
const CROSS: &str = r#"
[[definitions]]
name = "gyro_cross"
sensor = "gyroscope"
x = "k * wy * wz"
parameters = [{ name = "k", unit = "1/(rad/s)", typical = 1e-2 }]
"#;

#[test]
fn a_defined_effect_is_simulated_found_by_calibration_and_carried_in_its_file() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    let spec = format!("seed = 5\n[effects.gyro_cross]\nk = 0.02\n{CROSS}");
    std::fs::write(folder.join("spec.toml"), spec).unwrap();
    std::fs::write(folder.join("mine.toml"), CROSS).unwrap();
    let simulated = stillpoint(folder, &["simulate", "spec.toml", "-o", "session"]);
    assert!(simulated.status.success(), "{simulated:?}");
    let calibrate = [
        "calibrate",
        "session",
        "--effect-file",
        "mine.toml",
        "--effects",
        "gyro_cross",
        "--json",
        "-o",
        "cal.json",
    ];
    let calibration = json(&stillpoint(folder, &calibrate));
    let effect = &calibration["effects"][0];
    assert_eq!(effect["name"], "gyro_cross");
    assert_eq!(effect["definition"]["x"], "k * wy * wz");
    let k = &effect["parameters"][0];
    let (value, std) = (k["value"].as_f64().unwrap(), k["std"].as_f64().unwrap());
    // Seen to a few percent, and there: four standard errors are 1 in 16 000.
    assert!(std < 1e-3, "{std}");
    assert!((value - 0.02).abs() < 4.0 * std, "{value} ± {std}");
    // The calibration says what it corrects by: no need for the effect file.
    let apply = ["apply", "cal.json", "session", "-o", "corrected.csv"];
    let applied = stillpoint(folder, &apply);
    assert!(applied.status.success(), "{applied:?}");
}

#[test]
fn the_listing_has_the_defined_effects_after_the_catalogue() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("mine.toml"), CROSS).unwrap();
    let listed = stillpoint(
        dir.path(),
        &["effects", "--effect-file", "mine.toml", "--json"],
    );
    let listed = json(&listed);
    let last = listed.as_array().unwrap().last().unwrap();
    assert_eq!(last["name"], "gyro_cross");
    assert_eq!(last["equation"], "W_x += k * wy * wz");
    assert_eq!(last["parameters"][0]["unit"], "1/(rad/s)");
}

#[test]
fn an_effect_file_that_cannot_be_read_is_status_three_with_its_place() {
    let dir = tempfile::tempdir().unwrap();
    let broken = CROSS.replace("wy", "wq");
    std::fs::write(dir.path().join("mine.toml"), broken).unwrap();
    let refused = stillpoint(dir.path(), &["effects", "--effect-file", "mine.toml"]);
    assert_eq!(refused.status.code(), Some(3));
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    let place = "mine.toml:5:1: definitions.0.x: `k * wq * wz`, column 5: there is no `wq`";
    assert!(message.contains(place), "{message}");
    let missing = stillpoint(dir.path(), &["effects", "--effect-file", "none.toml"]);
    assert_eq!(missing.status.code(), Some(3));
}
