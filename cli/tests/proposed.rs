//! A formula for what no effect of the catalogue explains: shown, written as source, named once it is defined.

use calib::recording::to_csv;
use calib::simulate::Spec;
use sensor::{Axis, Covariate, Formula, Sensor, Term, emit_effect};

use crate::common::{stderr, stillpoint};

/// Specific force along two axes leaks into the rate about the third.
const SWIRL: &str = r#"
[[definitions]]
name = "gyro_swirl"
sensor = "gyroscope"
x = "k * fy * fz"
parameters = [{ name = "k", unit = "rad/s/(m/s^2)^2", typical = 5e-6 }]
"#;

/// A folder with the effect's file and a session in which it is hidden.
fn swirling() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let spec = format!("seed = 1\n[effects.gyro_swirl]\nk = 5e-6\n{SWIRL}");
    std::fs::write(dir.path().join("spec.toml"), spec).unwrap();
    std::fs::write(dir.path().join("mine.toml"), SWIRL).unwrap();
    let simulated = stillpoint(dir.path(), &["simulate", "spec.toml", "-o", "session"]);
    assert!(simulated.status.success(), "{}", stderr(&simulated));
    dir
}

#[test]
fn a_hidden_product_is_proposed_and_written_as_source_and_named_with_its_definition() {
    let dir = swirling();
    let folder = dir.path();
    let discover = ["discover", "session", "--emit-effect", "gyro_mine.rs"];
    let more = ["--json", "--report", "report.html"];
    let run = stillpoint(folder, &[&discover[..], &more].concat());
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let findings: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(findings["verdict"], "unexplained");
    let proposed = &findings["proposed"];
    assert_eq!(proposed["equation"], "W_x += x_fy_fz * fy * fz");
    let term = &proposed["terms"][0];
    let size = term["value"].as_f64().unwrap();
    let force = Covariate::SpecificForce;
    let product = [(force(Axis::Y), 1), (force(Axis::Z), 1)];
    let formula = Formula::new(Sensor::Gyroscope, vec![Term::new(Axis::X, &product, size)]);
    let written = std::fs::read_to_string(folder.join("gyro_mine.rs")).unwrap();
    assert_eq!(written, emit_effect(&formula, "gyro_mine").unwrap());
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    assert!(page.contains("Proposed: W_x += x_fy_fz * fy * fz"));

    let again = stillpoint(folder, &discover);
    assert_eq!(again.status.code(), Some(6), "{}", stderr(&again));
    assert!(stderr(&again).contains("exists already"));
    let forced = stillpoint(folder, &[&discover[..], &["--force", "-v"]].concat());
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
    let table = String::from_utf8_lossy(&forced.stdout).into_owned();
    assert!(
        table.contains("Proposed: W_x += x_fy_fz * fy * fz takes the gap"),
        "{table}"
    );

    let defined = ["discover", "session", "--effect-file", "mine.toml"];
    let report = ["--report", "named.html"];
    let named = stillpoint(folder, &[&defined[..], &report].concat());
    let said = String::from_utf8_lossy(&named.stdout).into_owned();
    assert!(
        said.starts_with("With care: the usual sensor model lacks gyro_swirl."),
        "{said}"
    );
    let page = std::fs::read_to_string(folder.join("named.html")).unwrap();
    assert!(page.contains("W_x += k * fy * fz"));
}

#[test]
fn without_a_proposal_no_source_is_written_and_that_is_said() {
    let dir = tempfile::tempdir().unwrap();
    let mut recording = Spec::hand_held(4).run().unwrap().recording;
    std::fs::write(dir.path().join("clean.csv"), to_csv(&mut recording)).unwrap();
    let args = ["discover", "clean.csv", "--emit-effect", "gyro_mine.rs"];
    let run = stillpoint(dir.path(), &args);
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    assert!(stderr(&run).contains("gyro_mine.rs: not written: no formula is proposed"));
    let left: Vec<_> = std::fs::read_dir(dir.path()).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn a_file_whose_name_no_effect_can_bear_is_refused_before_anything_is_read() {
    let dir = tempfile::tempdir().unwrap();
    for (file, words) in [
        ("Swirl.rs", "a name in snake case"),
        ("swirl.txt", "the ending .rs"),
        ("gyro_cubic.rs", "is another effect already"),
    ] {
        let run = stillpoint(dir.path(), &["discover", "none.csv", "--emit-effect", file]);
        assert_eq!(run.status.code(), Some(2), "{}", stderr(&run));
        assert!(stderr(&run).contains(words), "{}", stderr(&run));
    }
}
