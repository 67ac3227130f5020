//! `plan`: from nothing, from a recording, from a calibration.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use calib::recording::to_csv;
use calib::simulate::{HandHeld, Motion, Spec};
use common::{folder, json, status, stderr, stdout, stillpoint};

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
    let page = std::fs::read_to_string(dir.path().join("plan.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 12);
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
fn a_number_of_placements_that_is_no_plan_is_a_wrong_call() {
    let dir = tempfile::tempdir().unwrap();
    let run = stillpoint(dir.path(), &["plan", "--placements", "3"]);
    assert_eq!(status(&run), 2);
    assert!(stderr(&run).contains("6 to 60 expected"));
}
