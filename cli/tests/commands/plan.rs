//! `plan`: from nothing, from a recording, from a calibration.

use crate::common::{folder, json, status, stderr, stdout, stillpoint};
use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};

#[test]
fn a_plan_of_twelve_placements_has_words_turns_predictions_and_pictures() {
    let dir = tempfile::tempdir().unwrap();
    let call = [
        "plan",
        "--placements",
        "12",
        "--json",
        "-o",
        "plan.json",
        "--report",
        "plan.html",
    ];
    let run = stillpoint(dir.path(), &call);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let plan = json(&run);
    let steps = plan["plan"]["steps"].as_array().unwrap();
    assert_eq!(steps.len(), 12);
    assert!(steps[0]["turn"].is_null() && steps[1]["turn_words"].is_string());
    assert_eq!(
        plan["plan"]["after"]["standard_errors"]
            .as_array()
            .unwrap()
            .len(),
        21
    );
    let axes: Vec<&str> = steps.iter().map(|s| s["axes"].as_str().unwrap()).collect();
    assert_eq!(
        axes[..6],
        ["z up", "z down", "x up", "x down", "y up", "y down"]
    );
    for step in &steps[1..] {
        let words = step["turn_words"].as_str().unwrap();
        assert!(words.split_whitespace().count() <= 15, "{words}");
        assert!(!words.contains("way round first"), "{words}");
    }
    let page = std::fs::read_to_string(dir.path().join("plan.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 12);
    assert!(page.contains("default-src 'none'; style-src 'sha256-") && page.contains("<main>"));
    let file: serde_json::Value =
        serde_json::from_slice(&std::fs::read(dir.path().join("plan.json")).unwrap()).unwrap();
    assert_eq!(file, plan);
    let people = stdout(&stillpoint(dir.path(), &["plan", "--accelerometer-only"]));
    assert!(
        people.lines().all(|line| line.chars().count() <= 80),
        "{people}"
    );
    assert!(!people.to_lowercase().contains("turn it"), "{people}");
}

#[test]
fn a_short_recording_is_refused_with_the_placements_that_plan_names_too() {
    let dir = tempfile::tempdir().unwrap();
    let motion = HandHeld {
        placements: Some(6),
        initial_rest: Some(20.0),
        ..HandHeld::default()
    };
    let spec = Spec {
        motion: Motion::HandHeld(motion),
        ..Spec::hand_held(3)
    };
    let mut recording = spec.run().unwrap().recording;
    std::fs::write(dir.path().join("short.csv"), to_csv(&mut recording)).unwrap();
    let refused = stillpoint(
        dir.path(),
        &["calibrate", "short.csv", "--gravity", "9.80665"],
    );
    assert_eq!(status(&refused), 4);
    let said = stderr(&refused);
    assert!(said.contains(&plan::REQUIREMENT.to_string()), "{said}");
    let run = stillpoint(dir.path(), &["plan", "short.csv", "--json"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let wanted = json(&run)["coverage"]["wanted"].as_array().unwrap().clone();
    assert!(wanted.len() >= 4);
    for placement in wanted {
        let axes = placement["axes"].as_str().unwrap();
        assert!(said.contains(axes), "{axes}: {said}");
    }
}

#[test]
fn of_a_calibration_more_placements_lower_every_standard_error() {
    let (_dir, folder) = folder();
    let call = [
        "calibrate",
        "good.csv",
        "--gravity",
        "9.80665",
        "-o",
        "cal.json",
    ];
    assert_eq!(status(&stillpoint(&folder, &call)), 0);
    let run = stillpoint(&folder, &["plan", "cal.json", "--next", "4", "--json"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let plan = &json(&run)["plan"];
    assert_eq!(plan["steps"].as_array().unwrap().len(), 4);
    let error = |when: &str| plan[when]["force_error"].as_f64();
    assert!(error("after").unwrap() < error("before").unwrap());
}

#[test]
fn errors_of_a_calibration_are_those_of_its_file_and_gravity_is_not_told_by_placements() {
    let (_dir, folder) = folder();
    for given in [&["--gravity", "9.80665"][..], &[]] {
        let call = ["calibrate", "good.csv", "--force", "-o", "cal.json"];
        assert_eq!(
            status(&stillpoint(&folder, &[&call[..], given].concat())),
            0
        );
        let file = std::fs::read(folder.join("cal.json")).unwrap();
        let file: serde_json::Value = serde_json::from_slice(&file).unwrap();
        let run = stillpoint(&folder, &["plan", "cal.json", "--next", "4", "--json"]);
        assert_eq!(status(&run), 0, "{}", stderr(&run));
        let document = json(&run);
        let names = document["parameters"].as_array().unwrap();
        let own = file["parameters"].as_array().unwrap();
        for (k, name) in names.iter().enumerate() {
            let place = own.iter().position(|n| n == name).unwrap();
            let stated = file["covariance"][place][place].as_f64().unwrap().sqrt();
            let before = document["plan"]["before"]["standard_errors"][k]
                .as_f64()
                .unwrap();
            assert!(
                (before / stated - 1.0).abs() < 1e-6,
                "{name}: {before} {stated}"
            );
        }
        let after = document["plan"]["after"]["standard_errors"][0]
            .as_f64()
            .unwrap();
        // What is not known of gravity on the earth stays in every scale factor.
        assert_eq!(after > 2e-3, given.is_empty(), "{after}");
    }
}

#[test]
fn a_number_of_placements_that_is_no_plan_is_a_wrong_call() {
    let dir = tempfile::tempdir().unwrap();
    let run = stillpoint(dir.path(), &["plan", "--placements", "3"]);
    assert_eq!(status(&run), 2);
    assert!(stderr(&run).contains("6 to 60 expected"));
}

#[test]
fn printed_placements_keep_97_percent_of_the_relaxation_by_volume_and_95_by_a_reading() {
    let dir = tempfile::tempdir().unwrap();
    for (criterion, least) in [("volume", 0.97), ("reading", 0.95)] {
        for count in (9..=30).step_by(4) {
            let count = count.to_string();
            let run = stillpoint(
                dir.path(),
                &[
                    "plan",
                    "--placements",
                    &count,
                    "--criterion",
                    criterion,
                    "--json",
                ],
            );
            let found = &json(&run)["efficiency"];
            let own = found[criterion].as_f64().unwrap();
            println!("{criterion} {count}: {found}");
            assert!(
                (least..1.0005).contains(&own),
                "{criterion} {count}: {found}"
            );
        }
    }
}

/// Findings of a recording, with ties put in that nothing was recorded of.
fn findings_with_ties(folder: &std::path::Path) -> String {
    let call = ["discover", "good.csv", "--gravity", "9.80665", "--json"];
    let mut findings = json(&stillpoint(folder, &call));
    let rival = |name: &str, value: f64| {
        let coefficients = ["x", "y", "z"].map(|axis| format!("{name}.{axis}"));
        serde_json::json!({"name": name, "coefficients": coefficients, "values": ([value; 3]), "shape": null})
    };
    let tie = |named, other| {
        serde_json::json!({
            "named": named,
            "other": other,
            "recorded": {"parameters": [], "matrix": []},
            "separation": 0.0
        })
    };
    findings["effects"] = serde_json::json!([{
        "name": "accel_quadratic",
        "rivals": [
            tie(rival("accel_quadratic", 3e-4), rival("accel_asymmetry", 3e-3)),
            tie(rival("accel_temperature", 2e-3), rival("accel_scale_temperature", 2e-4)),
        ],
    }]);
    findings.to_string()
}

#[test]
fn findings_with_ties_get_the_recording_that_parts_them_and_what_would_part_the_others() {
    let (_dir, folder) = folder();
    std::fs::write(folder.join("findings.json"), findings_with_ties(&folder)).unwrap();
    let call = ["plan", "findings.json", "--next", "10"];
    let run = stillpoint(&folder, &[&call[..], &["--json"]].concat());
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let plan = json(&run);
    assert_eq!(plan["plan"]["steps"].as_array().unwrap().len(), 10);
    let [shape, warmth] = [0, 1].map(|k| plan["ties"][k].clone());
    assert_eq!(shape["told_apart"], "yes", "{shape}");
    assert_eq!(shape["before"], 0.0);
    // At one temperature neither does anything.
    assert_eq!(warmth["told_apart"], "no", "{warmth}");
    assert!(
        warmth["instead"]
            .as_str()
            .unwrap()
            .contains("--temperature"),
        "{warmth}"
    );
    let people = stdout(&stillpoint(&folder, &call));
    assert!(
        people.lines().all(|line| line.chars().count() <= 80),
        "{people}"
    );
    assert!(
        people.contains("accel_asymmetry") && people.contains("warm the device"),
        "{people}"
    );
}
