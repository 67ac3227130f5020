//! Calibrations that are used again: as they were written, edited, for another gravity.

use std::path::Path;

use crate::common::{folder, json, status, stderr, stillpoint};
use serde_json::Value;

fn run(path: &Path, call: &str) -> std::process::Output {
    stillpoint(path, &call.split(' ').collect::<Vec<_>>())
}

fn done(path: &Path, call: &str) -> std::process::Output {
    let output = run(path, call);
    assert!(status(&output) < 2, "{call}: {}", stderr(&output));
    output
}

#[test]
fn what_any_command_writes_verifies_and_an_edit_of_what_decides_does_not() {
    let (_dir, path) = folder();
    std::fs::write(path.join("limits.toml"), "[accelerometer]\nintervals = 5\n").unwrap();
    let identity = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
    std::fs::write(
        path.join("imu.yaml"),
        format!("accelerometers:\n  M: {identity}\n"),
    )
    .unwrap();
    for call in [
        "calibrate good.csv -o joint.json --limits limits.toml",
        "calibrate good.csv -o stepwise.json --method stepwise --latitude 48",
        "bias joint.json good.csv -o bias.json --accelerometer --no-gyroscope",
        "discover good.csv -o findings.json",
        "import imu.yaml -o imported.json",
        "batch good.csv.d -o batch",
    ] {
        if call.starts_with("batch") {
            std::fs::create_dir(path.join("good.csv.d")).unwrap();
            std::fs::copy(path.join("good.csv"), path.join("good.csv.d/good.csv")).unwrap();
        }
        done(&path, call);
    }
    for (k, file) in [
        "joint.json",
        "stepwise.json",
        "bias.json",
        "findings.json",
        "imported.json",
        "batch/devices/good/cal.json",
    ]
    .iter()
    .enumerate()
    {
        let said = stderr(&done(&path, &format!("export {file} --to c -o {k}.h")));
        assert!(!said.contains("edited"), "{file}: {said}");
        assert!(
            std::fs::read_to_string(path.join(file))
                .unwrap()
                .contains("basis_sha256")
        );
    }
    let whole: Value =
        serde_json::from_slice(&std::fs::read(path.join("joint.json")).unwrap()).unwrap();
    let edits: [(&str, Value); 8] = [
        ("/method", "stepwise".into()),
        ("/covariance/0/0", 1e-12.into()),
        ("/accelerometer/bias_std/0", 1e-9.into()),
        ("/gyroscope/T/0/0", 1.02.into()),
        ("/gravity_source", serde_json::json!({"kind": "given"})),
        ("/limits", Value::Array(Vec::new())),
        ("/inputs/0/samples_sha256", "0".into()),
        ("/effects", Value::Array(Vec::new())),
    ];
    for (pointer, value) in edits {
        let mut edited = whole.clone();
        let entry = edited.pointer_mut(pointer).unwrap();
        let is_other = *entry != value;
        *entry = value;
        std::fs::write(path.join("edited.json"), edited.to_string()).unwrap();
        for call in [
            "export edited.json --to px4 -o e.params --force",
            "apply edited.json good.csv -o a.csv --force --force-device",
            "evaluate good.csv --calibration e=edited.json",
        ] {
            let output = done(&path, call);
            assert_eq!(
                stderr(&output).contains("was edited since"),
                is_other,
                "{pointer}: {call}: {}",
                stderr(&output)
            );
        }
    }
    // What is made of an edited one stays so.
    let mut edited = whole.clone();
    edited["method"] = "stepwise".into();
    std::fs::write(path.join("edited.json"), edited.to_string()).unwrap();
    done(
        &path,
        "bias edited.json good.csv -o later.json --accelerometer --no-gyroscope",
    );
    assert!(
        stderr(&done(&path, "export later.json --to c -o later.h")).contains("was edited since")
    );
    // Another layout of the same document is no edit.
    std::fs::write(path.join("compact.json"), whole.to_string()).unwrap();
    assert!(!stderr(&done(&path, "export compact.json --to c -o compact.h")).contains("edited"));
}

#[test]
fn evaluate_compares_each_calibration_with_its_own_gravity_unless_told_otherwise() {
    let (_dir, path) = folder();
    done(&path, "calibrate good.csv -o high.json --gravity 9.78");
    done(&path, "calibrate good.csv -o low.json --gravity 9.83");
    let norm = |call: &str| {
        let output = done(&path, call);
        let rows = json(&output);
        let of = |k: usize| 1e3 * rows[k]["misfit"]["modulus_rms"].as_f64().unwrap();
        let count = rows.as_array().unwrap().len();
        ((1..count).map(of).collect::<Vec<f64>>(), stderr(&output))
    };
    let (alone, said) = norm("evaluate good.csv --json --calibration high=high.json");
    assert!(
        alone[0] < 3.0 && !said.contains("different gravities"),
        "{alone:?} {said}"
    );
    let (both, said) =
        norm("evaluate good.csv --json --calibration high=high.json --calibration low=low.json");
    assert!(
        both.iter().all(|v| *v < 3.0)
            && said.contains("high 9.78 m/s²")
            && said.contains("--gravity"),
        "{both:?} {said}"
    );
    let (told, said) = norm(
        "evaluate good.csv --json --calibration high=high.json --calibration low=low.json --gravity 9.83",
    );
    assert!(
        told[0] > 45.0 && told[1] < 3.0 && !said.contains("different gravities"),
        "{told:?} {said}"
    );
}

#[test]
fn an_option_of_the_stepwise_method_asks_for_it_and_is_refused_by_another() {
    let (_dir, path) = folder();
    for option in [
        "--integrator exponential",
        "--integrator first-order",
        "--gyro-bias adjacent",
        "--gyro-bias initial",
        "--nominal-rate 100",
    ] {
        let auto = json(&done(&path, &format!("calibrate good.csv --json {option}")));
        assert_eq!(auto["method"], "stepwise", "{option}");
        let name = option.split(' ').next().unwrap();
        for method in ["joint", "six-position"] {
            let refused = run(
                &path,
                &format!("calibrate good.csv --method {method} {option}"),
            );
            assert_eq!(status(&refused), 2, "{option}");
            let said = stderr(&refused);
            assert!(
                said.contains(name) && said.contains("--method stepwise"),
                "{said}"
            );
        }
    }
    assert_eq!(
        json(&done(&path, "calibrate good.csv --json"))["method"],
        "joint"
    );
}

/// The rows of a table of a recording with the rates in deg/s, under `header`; with `turn` only those in motion, about the fastest.
fn in_degrees(table: &str, header: &str, turn: bool) -> String {
    let row = |line: &str| -> Vec<f64> { line.split(',').map(|v| v.parse().unwrap()).collect() };
    let rows: Vec<Vec<f64>> = table.lines().skip(1).map(row).collect();
    let speed = |row: &Vec<f64>| row[4..7].iter().map(|v| v * v).sum::<f64>();
    let fastest = |a: &usize, b: &usize| speed(&rows[*a]).total_cmp(&speed(&rows[*b]));
    let middle = (0..rows.len()).max_by(fastest).unwrap();
    let near = |k: &usize| !turn || k.abs_diff(middle) < 40;
    let mut text = format!("{header}\n");
    for k in (0..rows.len()).filter(near) {
        let row = &rows[k];
        let cells = (0..7).map(|i| match i {
            0..4 => row[i].to_string(),
            _ => row[i].to_degrees().to_string(),
        });
        text += &(cells.collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

#[test]
fn a_run_that_names_no_unit_is_in_the_unit_of_the_calibrations_recording() {
    let (_dir, path) = folder();
    let table = std::fs::read_to_string(path.join("good.csv")).unwrap();
    let (bare, named) = (
        "t,ax,ay,az,gx,gy,gz",
        "t,ax,ay,az,gx [deg/s],gy [deg/s],gz [deg/s]",
    );
    for (name, header, turn) in [
        ("all.csv", bare, false),
        ("named.csv", named, false),
        ("run.csv", bare, true),
    ] {
        std::fs::write(path.join(name), in_degrees(&table, header, turn)).unwrap();
    }
    done(&path, "calibrate all.csv -o all.json");
    done(&path, "calibrate named.csv -o named.json");
    let said = stderr(&done(&path, "apply all.json run.csv -o run_corrected.csv"));
    assert!(said.contains("deg/s"), "{said}");
    done(&path, "apply all.json all.csv -o corrected.csv");
    let [part, whole] = ["run_corrected.csv", "corrected.csv"]
        .map(|name| std::fs::read_to_string(path.join(name)).unwrap());
    let rates = |line: &str| -> [f64; 2] {
        let mut cells = line.split(',').map(|v| v.parse::<f64>().unwrap());
        [cells.next().unwrap(), cells.nth(3).unwrap()]
    };
    let whole: Vec<[f64; 2]> = whole.lines().skip(1).map(rates).collect();
    for [t, rate] in part.lines().skip(1).map(rates) {
        let same = whole.iter().find(|[at, _]| *at == t).unwrap();
        assert!((same[1] - rate).abs() < 1e-9, "{t}: {} {rate}", same[1]);
    }
    // Another logger may write another unit.
    let other = "time,acc_x,acc_y,acc_z,gyro_x,gyro_y,gyro_z";
    std::fs::write(path.join("other.csv"), in_degrees(&table, other, true)).unwrap();
    let refused = run(&path, "apply all.json other.csv -o refused.csv");
    assert!(
        status(&refused) == 3 && stderr(&refused).contains("--gyro-unit deg/s"),
        "{}",
        stderr(&refused)
    );
    done(&path, "calibrate good.csv -o good.json");
    let said = stderr(&done(&path, "apply good.json other.csv -o assumed.csv"));
    assert!(said.contains("assumes rad/s"), "{said}");
    // Files that name their unit are of another kind.
    let refused = run(&path, "apply named.json run.csv -o named_corrected.csv");
    assert!(
        status(&refused) == 3 && stderr(&refused).contains("--gyro-unit deg/s"),
        "{}",
        stderr(&refused)
    );
    done(
        &path,
        "apply named.json run.csv -o named_corrected.csv --gyro-unit deg/s",
    );
}

#[test]
fn a_recording_read_with_other_signs_is_refused_and_an_export_says_which() {
    let (_dir, path) = folder();
    let table = std::fs::read_to_string(path.join("good.csv")).unwrap();
    let negated = table.lines().enumerate().map(|(k, line)| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if k > 0 {
            cells[4] = (-cells[4].parse::<f64>().unwrap()).to_string();
        }
        cells.join(",") + "\n"
    });
    std::fs::write(path.join("other.csv"), negated.collect::<String>()).unwrap();
    done(&path, "calibrate other.csv -o cal.json --flip gx");
    let refused = run(&path, "apply cal.json other.csv -o corrected.csv");
    assert!(
        status(&refused) == 3 && stderr(&refused).contains("--flip gx"),
        "{}",
        stderr(&refused)
    );
    for same in ["--flip gx", "--columns gx=-gx", "--force-device"] {
        done(
            &path,
            &format!("apply cal.json other.csv -o corrected.csv --force {same}"),
        );
    }
    let said = stderr(&done(&path, "export cal.json --to px4 -o imu.params"));
    assert!(said.contains("gx flipped"), "{said}");
}
