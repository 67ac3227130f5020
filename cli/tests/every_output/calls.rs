//! The calls, and a folder with what they read.

use std::path::PathBuf;

use crate::common::{folder, status, stderr, stillpoint};

/// A call without outputs, what it reads, and its outputs: option and name. A name with a slash is a file that the program
/// makes in the folder that the option names.
pub type Call = (
    &'static [&'static str],
    &'static [&'static str],
    &'static [(&'static str, &'static str)],
);

pub const CALLS: [Call; 25] = [
    (
        &[
            "calibrate",
            "good.csv",
            "--gyro-recording",
            "other.csv",
            "--effect-file",
            "fx.toml",
            "--effects",
            "gyro_cross",
            "--limits",
            "limits.toml",
        ],
        &["good.csv", "other.csv", "fx.toml", "limits.toml"],
        &[
            ("-o", "new.json"),
            ("--report", "new.html"),
            ("--plots", "plots/modulus.svg"),
        ],
    ),
    (
        &["calibrate", "good.csv", "--sections", "seg.json"],
        &["seg.json"],
        &[("-o", "new.json")],
    ),
    (
        &["calibrate", "--static-means", "means.csv"],
        &["means.csv"],
        &[("-o", "new.csv")],
    ),
    (
        &["calibrate", "good.csv", "--prior", "prior.json"],
        &["prior.json"],
        &[("-o", "new.json")],
    ),
    (
        &[
            "calibrate",
            "--accel-file",
            "session/acc.csv",
            "--gyro-file",
            "session/gyro.csv",
        ],
        &["session/acc.csv", "session/gyro.csv"],
        &[("-o", "new.csv"), ("--report", "new.html")],
    ),
    (
        &["calibrate", "session"],
        &["session/acc.csv"],
        &[("-o", "new.csv")],
    ),
    (
        &["segment", "good.csv"],
        &["good.csv"],
        &[
            ("-o", "new.csv"),
            ("--report", "new.html"),
            ("--plots", "plots/rests.svg"),
        ],
    ),
    (
        &["apply", "cal.json", "good.csv"],
        &["cal.json", "good.csv"],
        &[("-o", "new.csv"), ("-o", "made/acc.csv")],
    ),
    (
        &["convert", "good.csv"],
        &["good.csv"],
        &[("-o", "new.csv"), ("-o", "made/gyro.csv")],
    ),
    (
        &["allan", "good.csv", "--rest", "0,19"],
        &["good.csv"],
        &[
            ("-o", "new.csv"),
            ("--report", "new.html"),
            ("--plots", "plots/allan-gyroscope.svg"),
        ],
    ),
    (
        &["bias", "cal.json", "good.csv"],
        &["cal.json", "good.csv"],
        &[
            ("-o", "new.json"),
            ("--report", "new.html"),
            ("--plots", "plots/rates.png"),
        ],
    ),
    (
        &[
            "reckon",
            "good.csv",
            "--motion",
            "21,24",
            "--calibration",
            "mine=cal.json",
        ],
        &["good.csv", "cal.json"],
        &[
            ("-o", "new.csv"),
            ("--report", "new.html"),
            ("--plots", "plots/good-x.png"),
        ],
    ),
    (
        &[
            "evaluate",
            "good.csv",
            "--calibration",
            "mine=cal.json",
            "--limits",
            "limits.toml",
        ],
        &["good.csv", "cal.json", "limits.toml"],
        &[("--report", "new.html"), ("--plots", "plots/norm.svg")],
    ),
    (
        &["simulate", "spec.toml"],
        &["spec.toml"],
        &[("-o", "made/acc.csv"), ("-o", "made/truth.json")],
    ),
    (
        &[
            "discover",
            "good.csv",
            "--validation",
            "other.csv",
            "--noise",
            "noise.json",
            "--effect-file",
            "fx.toml",
        ],
        &["good.csv", "other.csv", "noise.json", "fx.toml"],
        &[
            ("-o", "new.json"),
            ("--report", "new.html"),
            ("--plots", "plots/gap.png"),
            ("--emit-effect", "gyro_new.rs"),
        ],
    ),
    (
        &[
            "discover",
            "--accel-file",
            "session/acc.csv",
            "--gyro-file",
            "session/gyro.csv",
        ],
        &["session/acc.csv", "session/gyro.csv"],
        &[("-o", "new.csv")],
    ),
    (
        &["plan", "cal.json"],
        &["cal.json"],
        &[("-o", "new.json"), ("--report", "new.html")],
    ),
    (
        &["export", "cal.json", "--to", "px4"],
        &["cal.json"],
        &[("-o", "new.json")],
    ),
    (
        &[
            "export",
            "cal.json",
            "--to",
            "kalibr",
            "--noise",
            "noise.json",
        ],
        &["cal.json", "noise.json"],
        &[("-o", "new.json")],
    ),
    (
        &[
            "export",
            "cal.json",
            "--to",
            "ardupilot",
            "--logged-with",
            "log.param",
        ],
        &["cal.json", "log.param"],
        &[("-o", "new.param")],
    ),
    (
        &["export", "cal.json", "--to", "imu_tk"],
        &["cal.json"],
        &[("-o", "made/acc.calib")],
    ),
    (
        &["import", "imu.yaml"],
        &["imu.yaml"],
        &[("-o", "new.yaml")],
    ),
    (
        &[
            "batch",
            "devices",
            "--prior",
            "prior.json",
            "--limits",
            "limits.toml",
        ],
        &["prior.json", "limits.toml", "devices/d.csv"],
        &[("-o", "made/part-1-of-1.jsonl")],
    ),
    (
        &["batch", "merge", "out"],
        &["out/part-1-of-1.jsonl"],
        &[("-o", "new.jsonl")],
    ),
    (
        &["batch", "prior", "out"],
        &["out/devices/d/cal.json"],
        &[("-o", "new.json")],
    ),
];

/// Options of these write something, and read nothing that could be written over.
pub const WITHOUT_INPUT: [(&[&str], &str, &str); 2] = [
    (&["demo"], "--out", "made/cal.json"),
    (&["generate"], "--man", "made/stillpoint.1"),
];

const EFFECT: &str = r#"
[[definitions]]
name = "gyro_cross"
sensor = "gyroscope"
x = "k * wy * wz"
parameters = [{ name = "k", unit = "1/(rad/s)", typical = 1e-2 }]
"#;

/// A folder with every input.
pub fn furnished() -> (tempfile::TempDir, PathBuf) {
    let (dir, folder) = folder();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    std::fs::copy(folder.join("good.csv"), folder.join("other.csv")).unwrap();
    std::fs::create_dir(folder.join("devices")).unwrap();
    std::fs::copy(folder.join("good.csv"), folder.join("devices/d.csv")).unwrap();
    write("fx.toml", EFFECT);
    write("limits.toml", "required = [\"accelerometer\"]\n");
    write("means.csv", "ax,ay,az\n0,0,9.8\n");
    write("log.param", "INS_ACCSCAL_X,1.0\n");
    write("spec.toml", "seed = 1\n[motion.still]\nduration = 5.0\n");
    let made: [&[&str]; 7] = [
        &["convert", "good.csv", "-o", "session"],
        &["calibrate", "good.csv", "-o", "cal.json"],
        &["segment", "good.csv", "-o", "seg.json"],
        &["allan", "good.csv", "--rest", "0,19", "-o", "noise.json"],
        &[
            "export",
            "cal.json",
            "--to",
            "kalibr",
            "-o",
            "imu.yaml",
            "--noise",
            "noise.json",
        ],
        &["batch", "devices", "-o", "out"],
        &[
            "batch",
            "prior",
            "out/devices/d/cal.json",
            "-o",
            "prior.json",
        ],
    ];
    for call in made {
        let run = stillpoint(&folder, call);
        // The one device may fail a gate, and one is too few for a prior.
        assert!(
            [0, 1, 4].contains(&status(&run)),
            "{call:?}: {}",
            stderr(&run)
        );
    }
    if !folder.join("prior.json").exists() {
        write("prior.json", PRIOR);
    }
    (dir, folder)
}

const PRIOR: &str = r#"{"schema": "stillpoint.prior/1", "created_by": "stillpoint", "devices": 3, "outsiders": [], "without": 0,
    "effects": [], "parameters": [], "mean": [], "covariance": [], "mean_covariance": []}"#;
