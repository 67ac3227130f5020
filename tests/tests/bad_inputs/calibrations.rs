//! Cases 84, 136 and 137: sign conventions, edited calibrations, calibrations of another device, unit or sign.

use serde_json::{Value, json};

use super::bench::Bench;
use super::device::{Row, csv, good, rows, spec};

/// A folder with `r.csv` and its calibration `cal.json`.
fn calibrated() -> Bench {
    let bench = Bench::with("r.csv", csv(good()));
    bench.run(&["calibrate", "r.csv", "-o", "cal.json"]).ends(0);
    bench
}

fn read(bench: &Bench, name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(bench.path(name)).unwrap()).unwrap()
}

/// `cal.json` with one entry (a JSON pointer) changed, as `edited.json`.
fn edit(bench: &Bench, entry: &str, value: Value) {
    let mut calibration = read(bench, "cal.json");
    *calibration.pointer_mut(entry).unwrap() = value;
    bench.write("edited.json", calibration.to_string());
}

#[test]
fn case_84_the_sign_convention_is_said() {
    let bench = calibrated();
    let said = read(&bench, "cal.json")["sign_convention"].to_string();
    assert!(said.contains("+g on the axis that points up"), "{said}");
    let help = bench.command(&["calibrate", "--help"]).output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    assert!(help.contains("+g on the axis that points up"), "{help}");
}

#[test]
fn case_136_an_edited_calibration_is_refused_by_entry_or_warned_about() {
    let bench = calibrated();
    let swapped = read(&bench, "cal.json");
    for (entry, value, says) in [
        (
            "/accelerometer/T",
            json!([[1, 0, 0], [0, 0, 0], [0, 0, 1]]),
            "accelerometer.T",
        ),
        (
            "/accelerometer/T",
            json!([[1, 0, 0], [0, 1, 0], [0, 0]]),
            "edited.json:",
        ),
        ("/accelerometer/T/0/0", json!(40.0), "accelerometer.T"),
        ("/accelerometer/bias/2", json!(400.0), "accelerometer.bias"),
        ("/gyroscope/bias/0", json!(9.0), "gyroscope.bias"),
        ("/gyroscope/bias/0", json!(null), "edited.json:"),
        ("/gyroscope", swapped["accelerometer"].clone(), "swapped"),
    ] {
        edit(&bench, entry, value);
        bench
            .run(&["apply", "edited.json", "r.csv", "-o", "out.csv"])
            .ends(3)
            .says(&[says])
            .changes(&[]);
    }
    edit(&bench, "/gyroscope/T/1/1", json!(1.02));
    bench
        .run(&["apply", "edited.json", "r.csv", "-o", "out.csv"])
        .ends(0)
        .says(&["was edited since it was written"]);
}

/// What is recorded, changed row by row.
fn foreign(change: impl Fn(&mut Row)) -> String {
    let mut all = good().to_vec();
    all.iter_mut().for_each(change);
    csv(&all)
}

#[test]
fn case_137_a_calibration_of_another_unit_sign_or_order_is_refused() {
    let bench = calibrated();
    let recordings = [
        (
            "degrees.csv",
            foreign(|row| row[4..].iter_mut().for_each(|w| *w = w.to_degrees())),
            "--gyro-unit deg/s",
        ),
        (
            "sign.csv",
            foreign(|row| row[4..].iter_mut().for_each(|w| *w = -*w)),
            "--force-device",
        ),
        ("order.csv", foreign(|row| row.swap(4, 5)), "--force-device"),
    ];
    for (name, text, remedy) in recordings {
        bench.write(name, text);
        bench
            .run(&[
                "apply",
                "cal.json",
                name,
                "-o",
                "out.csv",
                "--accel-unit",
                "m/s^2",
                "--gyro-unit",
                "rad/s",
            ])
            .ends(3)
            .says(&[name, remedy])
            .changes(&[]);
    }
    bench
        .run(&[
            "apply",
            "cal.json",
            "sign.csv",
            "-o",
            "out.csv",
            "--force-device",
        ])
        .ends(0);
}

#[test]
fn case_137_the_bias_of_another_device_is_warned_about_and_shown_apart() {
    let bench = calibrated();
    bench.write("moved.csv", foreign(|row| row[4] += 0.1));
    let run = bench.run(&[
        "evaluate",
        "moved.csv",
        "--calibration",
        "c=cal.json",
        "--json",
    ]);
    run.ends(0).says(&["rate at rest", "stillpoint bias"]);
    let rate = run.json()[1]["misfit"]["static_rate"][0].as_f64().unwrap();
    assert!((rate - 0.1).abs() < 0.005, "{rate}");
    let other = rows(&spec(99));
    bench.write("other.csv", csv(&other));
    bench
        .run(&["apply", "cal.json", "other.csv", "-o", "out.csv"])
        .says(&["may be of another device"]);
}

#[test]
fn a_calibration_says_what_it_was_made_from() {
    let bench = calibrated();
    let calibration = read(&bench, "cal.json");
    let input = &calibration["inputs"][0];
    assert_eq!(input["recording"], "r.csv");
    assert_eq!(input["samples_sha256"].as_str().unwrap().len(), 64);
    assert_eq!(input["accelerometer"]["samples"], good().len());
    let rate = input["gyroscope"]["rate"].as_f64().unwrap();
    assert!((rate - 100.0).abs() < 0.1, "{rate}");
    // White noise of a consumer-grade device, by the scatter of twenty intervals.
    for (sensor, density) in [("accelerometer", 2e-3), ("gyroscope", 1e-4)] {
        let found = input[sensor]["noise_density"].as_f64().unwrap();
        assert!((found / density - 1.0).abs() < 0.1, "{sensor}: {found}");
    }
    for entry in [
        "version",
        "gravity_source",
        "misfit",
        "options",
        "clocks",
        "numbers_sha256",
    ] {
        assert!(!calibration[entry].is_null(), "{entry}");
    }
    assert_eq!(calibration["accelerometer"]["units"]["reading"], "m/s^2");
    assert_eq!(calibration["options"]["method"], calibration["method"]);
}
