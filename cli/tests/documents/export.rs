//! `export` and `import` as a person calls them; every line of the manual's table of targets.

use crate::common::{files, folder, json, status, stderr, stdout, stillpoint};

const TARGETS: [&str; 12] = [
    "imu_tk",
    "kalibr",
    "ros",
    "ros2",
    "px4",
    "ardupilot",
    "c",
    "rust",
    "toml",
    "matlab",
    "numpy",
    "npz",
];

/// A folder with `good.csv` and its `cal.json`.
fn calibrated() -> (tempfile::TempDir, std::path::PathBuf) {
    let (dir, path) = folder();
    let run = stillpoint(&path, &["calibrate", "good.csv", "-o", "cal.json"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    (dir, path)
}

#[test]
fn every_line_of_the_table_of_targets_runs() {
    let chapter = include_str!("../../manual/files.md");
    let lines: Vec<&str> = chapter
        .lines()
        .filter(|line| line.starts_with('|') && line.contains("`stillpoint export "))
        .collect();
    let (_dir, path) = calibrated();
    let mut seen = Vec::new();
    for line in lines {
        let command = line
            .split("`stillpoint ")
            .nth(1)
            .unwrap()
            .split('`')
            .next()
            .unwrap();
        let args: Vec<&str> = command.split_whitespace().collect();
        let run = stillpoint(&path, &args);
        assert_eq!(status(&run), 0, "{command}: {}", stderr(&run));
        seen.push(args[args.iter().position(|a| *a == "--to").unwrap() + 1].to_owned());
        let output = args[args.iter().position(|a| *a == "-o").unwrap() + 1];
        assert!(path.join(output).exists(), "{command}");
    }
    assert_eq!(seen, TARGETS);
}

#[test]
fn what_is_lost_is_printed_with_its_size_and_as_json() {
    let (_dir, path) = calibrated();
    let call = ["export", "cal.json", "--to", "px4", "-o", "imu.params"];
    let run = stillpoint(&path, &call);
    let said = stdout(&run);
    let named = [
        "the export leaves out misalignments of the accelerometer: ",
        "m/s² at 1 g",
        "scale factors of the gyroscope",
        "°/s at 1 rad/s",
    ];
    for words in named {
        assert!(said.contains(words), "{said}");
    }
    assert!(stderr(&run).contains("CAL_ACC0_ID"));
    let run = stillpoint(&path, &[&call[..], &["--force", "--json"]].concat());
    let document = json(&run);
    assert_eq!(document["target"], "px4");
    assert!(
        document["lost"][0]["size"].as_f64().unwrap() > 0.0
            && document["lost"][0]["unit"] == "m/s^2"
    );
    let run = stillpoint(
        &path,
        &["export", "cal.json", "--to", "toml", "-o", "cal.toml"],
    );
    assert_eq!(stdout(&run).trim(), "nothing is lost");
}

#[test]
fn what_comes_back_is_as_good_on_the_recording() {
    let (_dir, path) = folder();
    // Rests long enough for `bias`, which an import from Kalibr needs.
    let spec = "seed = 5\ngrade = \"consumer\"\n[motion.hand_held]\nplacements = 16\ninitial_rest = 40.0\n";
    std::fs::write(path.join("spec.toml"), spec).unwrap();
    for call in [
        &["simulate", "spec.toml", "-o", "run"][..],
        &["calibrate", "run", "--method", "stepwise", "-o", "cal.json"],
        &["export", "cal.json", "--to", "imu_tk", "-o", "tk"],
        &["import", "tk", "-o", "tk.json"],
        &[
            "import",
            "tk/acc.calib",
            "tk/gyro.calib",
            "--from",
            "imu_tk",
            "-o",
            "again.json",
        ],
        &["export", "cal.json", "--to", "kalibr", "-o", "imu.yaml"],
        &["import", "imu.yaml", "-o", "kalibr.json"],
        &[
            "bias",
            "kalibr.json",
            "run",
            "--accelerometer",
            "-o",
            "biased.json",
        ],
    ] {
        let run = stillpoint(&path, call);
        assert_eq!(status(&run), 0, "{call:?}: {}", stderr(&run));
    }
    let names = [
        "own=cal.json",
        "tk=tk.json",
        "again=again.json",
        "kalibr=biased.json",
    ];
    let mut call = vec!["evaluate", "run", "--json"];
    names
        .iter()
        .for_each(|name| call.extend(["--calibration", name]));
    let run = stillpoint(&path, &call);
    let rows = json(&run);
    let misfit = |k: usize, key: &str| rows[k]["misfit"][key].as_f64().unwrap();
    let (raw, own) = (misfit(0, "modulus_rms"), misfit(1, "modulus_rms"));
    assert!(own < 0.1 * raw, "{rows}");
    for k in 2..4 {
        assert!(
            (misfit(k, "modulus_rms") / own - 1.0).abs() < 1e-9,
            "{rows}"
        );
    }
    // Kalibr's file has no biases: those estimated since are as good to a few per cent.
    assert!((misfit(4, "modulus_rms") / own - 1.0).abs() < 0.2, "{rows}");
    assert!(
        (misfit(4, "direction_rms") / misfit(1, "direction_rms") - 1.0).abs() < 0.05,
        "{rows}"
    );
}

#[test]
fn bad_calls_and_bad_files_change_nothing() {
    let (_dir, path) = calibrated();
    let text = std::fs::read_to_string(path.join("cal.json")).unwrap();
    let mut lame: serde_json::Value = serde_json::from_str(&text).unwrap();
    lame["gyroscope"] = serde_json::Value::Null;
    std::fs::write(path.join("lame.json"), lame.to_string()).unwrap();
    std::fs::write(path.join("there.yaml"), "mine").unwrap();
    std::fs::write(path.join("bad.yaml"), "a: [1, 2").unwrap();
    let before = files(&path);
    let calls: [(&[&str], i32, &str); 14] = [
        (
            &["export", "cal.json", "--to", "px5", "-o", "x"],
            2,
            "use one of imu_tk, kalibr",
        ),
        (&["export", "cal.json", "-o", "x"], 2, "--to"),
        (
            &["export", "none.json", "--to", "px4", "-o", "x"],
            3,
            "none.json",
        ),
        (
            &["export", "good.csv", "--to", "px4", "-o", "x"],
            3,
            "no JSON",
        ),
        (
            &["export", "lame.json", "--to", "kalibr", "-o", "x.yaml"],
            4,
            "no gyroscope",
        ),
        (
            &["export", "cal.json", "--to", "ros", "-o", "there.yaml"],
            6,
            "--force",
        ),
        (
            &[
                "export", "cal.json", "--to", "ros", "-o", "cal.json", "--force",
            ],
            2,
            "is the input",
        ),
        (
            &["export", "cal.json", "--to", "imu_tk", "-o", "imu.calib"],
            2,
            "name a folder",
        ),
        (
            &[
                "export",
                "cal.json",
                "--to",
                "c",
                "--instance",
                "1",
                "-o",
                "x.h",
            ],
            2,
            "means nothing to c",
        ),
        (
            &[
                "export",
                "cal.json",
                "--to",
                "px4",
                "--instance",
                "9",
                "-o",
                "x",
            ],
            2,
            "0 to 3",
        ),
        (
            &[
                "export", "cal.json", "--to", "kalibr", "--noise", "cal.json", "-o", "x.yaml",
            ],
            3,
            "allan",
        ),
        (&["import", "bad.yaml", "-o", "x.json"], 3, "bad.yaml"),
        (
            &[
                "import",
                "cal.json",
                "good.csv",
                "there.yaml",
                "-o",
                "x.json",
            ],
            2,
            "expected",
        ),
        (
            &["import", "bad.yaml", "-o", "bad.yaml", "--force"],
            2,
            "is the input",
        ),
    ];
    for (call, expected, words) in calls {
        let run = stillpoint(&path, call);
        let said = stderr(&run);
        assert_eq!(status(&run), expected, "{call:?}: {said}");
        assert!(said.contains(words), "{call:?}: {said}");
        assert!(run.stdout.is_empty());
    }
    assert_eq!(files(&path), before);
    assert_eq!(
        std::fs::read_to_string(path.join("there.yaml")).unwrap(),
        "mine"
    );
    assert_eq!(
        std::fs::read_to_string(path.join("cal.json")).unwrap(),
        text
    );
}
