//! What a report says, where it goes, and recordings that a command must refuse or mark.

use std::fmt::Write as _;
use std::path::Path;

use crate::common::{stderr, stillpoint};

/// A plain CSV at 50 Hz: rests of `rest` seconds with the given specific forces, shaken by hand for
/// three seconds between.
fn recording(path: &Path, forces: &[[f64; 3]], rest: f64) {
    // White noise by the generator of NIST SP 1065, section 12.4.
    let mut state = 1_234_567_890_u64;
    let mut noise = move || {
        state = 16_807 * state % 2_147_483_647;
        state as f64 / 2_147_483_647.0 - 0.5
    };
    let mut text = String::from("t,ax,ay,az,gx,gy,gz\n");
    let mut k = 0;
    for (place, force) in forces.iter().enumerate() {
        let shaken = if place > 0 { 3.0 } else { 0.0 };
        for sample in 0..((rest + shaken) * 50.0) as usize {
            let size = if (sample as f64) < shaken * 50.0 {
                5.0
            } else {
                1e-3
            };
            let [x, y, z] = force.map(|f| f + size * noise());
            let [p, q, r] = [0; 3].map(|_| size * noise());
            writeln!(text, "{:.2},{x},{y},{z},{p},{q},{r}", f64::from(k) * 0.02).unwrap();
            k += 1;
        }
    }
    std::fs::write(path, text).unwrap();
}

const UP: [f64; 3] = [0.0, 0.0, 9.8];

#[test]
fn a_recording_full_of_turns_has_no_allan_deviation() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("turns.csv"), &[UP; 5], 10.0);
    let output = stillpoint(dir.path(), &["allan", "turns.csv"]);
    assert_eq!(output.status.code(), Some(4));
    let said = stderr(&output);
    // The first shake is from 10 to 13 s; blocks of a second on either side are taken with it.
    assert!(
        said.contains("moved (t = 9.") || said.contains("moved (t = 8."),
        "{said}"
    );
    assert!(said.contains("--rest T0,T1"), "{said}");
    assert!(output.stdout.is_empty());
}

#[test]
fn of_a_recording_that_also_moves_the_longest_rest_is_analysed_streamed_or_not() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("two.csv"), &[UP; 2], 100.0);
    let mut results = Vec::new();
    for more in [&[][..], &["--format", "csv"]] {
        let args = [&["allan", "two.csv", "--json"], more].concat();
        let output = stillpoint(dir.path(), &args);
        assert!(output.status.success(), "{}", stderr(&output));
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let warning = summary["warnings"][0].as_str().unwrap();
        assert!(warning.contains("only the longest rest"), "{warning}");
        let samples = summary["gyroscope"]["samples"].as_u64().unwrap();
        // A hundred seconds at 50 Hz, less two at an end.
        assert!((4850..=5000).contains(&samples), "{samples}");
        results.push(summary);
    }
    assert_eq!(results[0], results[1]);
    let args = ["allan", "two.csv", "--rest", "5,95", "--json"];
    let named: serde_json::Value =
        serde_json::from_slice(&stillpoint(dir.path(), &args).stdout).unwrap();
    assert_eq!(named["gyroscope"]["samples"], 4500);
    assert!(!named["warnings"].to_string().contains("moved"));
}

#[test]
fn a_stretch_that_ends_before_it_begins_is_a_wrong_call() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("rest.csv"), &[UP], 20.0);
    let output = stillpoint(dir.path(), &["allan", "rest.csv", "--rest", "9,3"]);
    assert_eq!(output.status.code(), Some(2));
}

/// The six faces, each leaning by `degrees` to one side.
fn leaning(degrees: f64) -> Vec<[f64; 3]> {
    let (along, across) = (
        9.8 * degrees.to_radians().cos(),
        9.8 * degrees.to_radians().sin(),
    );
    (0..6)
        .map(|face| {
            let mut force = [0.0; 3];
            force[face / 2] = if face % 2 == 0 { along } else { -along };
            force[(face / 2 + 1) % 3] = across;
            force
        })
        .collect()
}

#[test]
fn six_positions_far_from_level_fail_with_status_1_and_the_report_says_so_first() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("level.csv"), &leaning(0.0), 10.0);
    recording(&dir.path().join("lean.csv"), &leaning(5.0), 10.0);
    let run = |name: &str| {
        let args = ["calibrate", "--method", "six-position", "--gravity", "9.8"];
        let files = [
            "-o",
            &format!("{name}.json"),
            "--report",
            &format!("{name}.html"),
        ];
        let recording = format!("{name}.csv");
        stillpoint(dir.path(), &[&args[..], &files, &[&recording]].concat())
    };
    let level = run("level");
    assert_eq!(level.status.code(), Some(0), "{}", stderr(&level));
    let lean = run("lean");
    assert_eq!(lean.status.code(), Some(1), "{}", stderr(&lean));
    assert!(stderr(&lean).contains("level the device on each face"));
    let cal = std::fs::read_to_string(dir.path().join("lean.json")).unwrap();
    assert!(cal.contains("failed_gates"), "the file is marked");
    let page = std::fs::read_to_string(dir.path().join("lean.html")).unwrap();
    let (gate, warning) = (
        page.find("Do not use").unwrap(),
        page.find("This method takes every face as level").unwrap(),
    );
    let next = page.find("What to do next").unwrap();
    assert!(gate < next && next < warning && warning < page.find("<section>").unwrap());
}

/// What a parser can see: one title, named pictures and tables, headings without a jump, ids once, no inline style.
fn is_accessible(page: &str) {
    assert!(page.contains("<html lang=\"en\">") && page.matches("<h1>").count() == 1);
    assert!(!page.contains("<h3") && page.matches("<main>").count() == 1);
    for (tag, name) in [
        ("role=\"img\"", "aria-label=\""),
        ("role=\"region\"", "aria-label=\""),
    ] {
        for part in page.split(tag).skip(1) {
            let end = part.find('>').unwrap();
            let label = part[..end].split(name).nth(1);
            assert!(label.is_some_and(|label| !label.starts_with('"')), "{tag}");
        }
    }
    assert_eq!(page.matches(" id=").count(), 1);
    assert!(!page.contains(" style="));
}

#[test]
fn a_refusal_writes_a_report_with_what_there_is_and_the_placements_to_add() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("few.csv"), &leaning(0.0)[..4], 10.0);
    let args = [
        "calibrate",
        "few.csv",
        "--gravity",
        "9.8",
        "--report",
        "few.html",
        "-o",
        "few.json",
    ];
    let output = stillpoint(dir.path(), &args);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(!dir.path().join("few.json").exists());
    let page = std::fs::read_to_string(dir.path().join("few.html")).unwrap();
    let at = |words: &str| page.find(words).unwrap_or_else(|| panic!("no {words}"));
    assert!(at("There is no calibration") < at("What to do next"));
    // Four of six faces are there: z is missing both ways.
    assert!(page.contains("too few placements") && page.contains("no placement has z up, z down"));
    let next = &page[at("What to do next")..at("What there is")];
    assert!(next.contains("z up") && next.contains("z down"), "{next}");
    assert!(page.contains("4 of 6 faces") && page.contains("class=\"sphere\""));
    is_accessible(&page);
}

#[test]
fn an_evaluation_has_a_report_that_compares_with_the_raw_readings() {
    let dir = tempfile::tempdir().unwrap();
    sessions(dir.path());
    let made = stillpoint(
        dir.path(),
        &["calibrate", "one", "--gravity", "9.80665", "-o", "cal.json"],
    );
    assert!(made.status.success(), "{}", stderr(&made));
    let args = [
        "evaluate",
        "one",
        "--calibration",
        "own=cal.json",
        "--report",
        "e.html",
    ];
    let output = stillpoint(dir.path(), &args);
    assert!(output.status.success(), "{}", stderr(&output));
    let page = std::fs::read_to_string(dir.path().join("e.html")).unwrap();
    for words in [
        "With own this recording meets gravity",
        "What to do next",
        "calibrated, mm/s²",
        "SHA-256",
    ] {
        assert!(page.contains(words), "{words}");
    }
    is_accessible(&page);
}

const SESSION: &str = "seed = 7\nrate = 100.0\ngrade = \"consumer\"\n[motion.hand_held]\n\
placements = 14\ninitial_rest = 10.0\nrest = [4.0, 5.0]\nturn = [2.0, 3.0]\n";

/// Two simulated sessions; another seed is also another device.
fn sessions(folder: &Path) {
    for (name, seed) in [("one", "seed = 7"), ("two", "seed = 8")] {
        let spec = format!("{name}.toml");
        std::fs::write(folder.join(&spec), SESSION.replace("seed = 7", seed)).unwrap();
        let made = stillpoint(folder, &["simulate", &spec, "-o", name]);
        assert!(made.status.success(), "{}", stderr(&made));
    }
}

#[test]
fn a_calibrations_report_tells_recordings_rests_and_turns_apart() {
    let dir = tempfile::tempdir().unwrap();
    sessions(dir.path());
    let args = [
        "calibrate",
        "one",
        "two",
        "--force-device",
        "--report",
        "cal.html",
        "--plots",
        "p",
    ];
    let output = stillpoint(dir.path(), &args);
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{}",
        stderr(&output)
    );
    let page = std::fs::read_to_string(dir.path().join("cal.html")).unwrap();
    // One drawing serves light and dark pages.
    assert_eq!(
        page.matches("<svg").count(),
        page.matches("<figure>").count()
    );
    assert!(page.len() < 250_000, "{}", page.len());
    // Fourteen placements each, numbered through both recordings.
    for words in [
        "alpha_yz",
        "beta_xy",
        "std error",
        "Static intervals of one",
        "Static intervals of two",
        "<td>static 28<",
        "What to do next",
        "SHA-256 of the samples",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("<link"));
    for name in [
        "modulus",
        "direction",
        "coverage",
        "parameters",
        "rests-1",
        "rests-2",
    ] {
        for ending in ["svg", "png"] {
            let file = dir.path().join(format!("p/{name}.{ending}"));
            assert!(file.is_file(), "{name}.{ending}");
        }
    }
    is_accessible(&page);
}

#[test]
fn what_the_page_says_of_a_touched_device_mends_the_calibration() {
    let dir = tempfile::tempdir().unwrap();
    let touched = "[[faults]]\ndisturbed = { interval = 7, size = 0.08 }\n";
    std::fs::write(dir.path().join("run.toml"), [SESSION, touched].concat()).unwrap();
    let made = stillpoint(dir.path(), &["simulate", "run.toml", "-o", "run"]);
    assert!(made.status.success(), "{}", stderr(&made));
    let calibrate = |more: &[&str]| {
        let args = ["calibrate", "run", "-v", "--gravity", "9.80665", "--force"];
        let outputs = ["-o", "cal.json", "--report", "cal.html"];
        let output = stillpoint(dir.path(), &[&args[..], &outputs, more].concat());
        let page = std::fs::read_to_string(dir.path().join("cal.html")).unwrap();
        (output, page.replace("</span>", "").replace("<span>", ""))
    };
    // The joint method finds it itself.
    let (output, page) = calibrate(&[]);
    let said = stderr(&output);
    let touched = "something touched or pushed the device";
    assert!(
        said.contains("static interval 8 (") && said.contains(touched),
        "{said}"
    );
    assert!(page.contains("does not use the accelerometer"), "{said}");
    let stepwise = |more: &[&str]| calibrate(&[&["--method", "stepwise"], more].concat());
    let (output, page) = stepwise(&[]);
    // The turns on either side are sound.
    let said = stderr(&output);
    assert!(
        said.contains("static interval 8 (") && !said.contains("rows lost"),
        "{said}"
    );
    let next = page.split("--leave-out ").nth(1).expect("the option");
    let instant = next.split(' ').next().unwrap();
    let (output, page) = stepwise(&["--leave-out", instant]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        page.contains("The model explains the recording"),
        "{}",
        stderr(&output)
    );
    assert!(page.contains(&format!("static intervals left out at {instant} s")));
    // A wrong one is refused with the nearest.
    for (wrong, words) in [
        ("1e5", "the nearest lasts from"),
        ("2:50", "no recording 2"),
        ("x", "a stamp in s"),
    ] {
        let (output, _) = calibrate(&["--leave-out", wrong]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[test]
fn segment_draws_the_rests_it_found() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("two.csv"), &[UP; 2], 10.0);
    let output = stillpoint(dir.path(), &["segment", "two.csv", "--report", "cut.html"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let page = std::fs::read_to_string(dir.path().join("cut.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 2);
    assert!(page.contains("static 2") && page.contains("turn 1") && !page.contains("static 3"));
}

#[test]
fn a_report_and_a_result_of_one_name_are_a_wrong_call_and_leave_nothing() {
    let dir = tempfile::tempdir().unwrap();
    recording(&dir.path().join("rest.csv"), &[UP], 20.0);
    for (o, report) in [("same", "same"), ("same", "./same")] {
        for command in ["calibrate", "allan", "segment"] {
            let args = [command, "rest.csv", "-o", o, "--report", report];
            let output = stillpoint(dir.path(), &args);
            assert_eq!(
                output.status.code(),
                Some(2),
                "{command}: {}",
                stderr(&output)
            );
            assert!(stderr(&output).contains("two outputs"));
        }
    }
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);
}
