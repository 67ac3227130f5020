//! What a terminal sees: widths, colours, silence, a file alone, completions and manual pages.

use crate::common::{files, folder, status, stderr, stdout, stillpoint};

const COMMANDS: [&str; 19] = [
    "batch",
    "live",
    "plan",
    "demo",
    "info",
    "calibrate",
    "segment",
    "apply",
    "convert",
    "allan",
    "bias",
    "reckon",
    "evaluate",
    "simulate",
    "discover",
    "effects",
    "export",
    "import",
    "page",
];

/// No line is wider than a terminal of 80 columns.
fn fits(text: &str, what: &str) {
    for line in text.lines() {
        let columns = line.chars().count();
        assert!(columns <= 80, "{what}: {columns} columns: {line}");
    }
}

#[test]
fn the_help_of_every_command_fits_into_80_columns() {
    let dir = tempfile::tempdir().unwrap();
    let run = stillpoint(dir.path(), &["--help"]);
    fits(&stdout(&run), "--help");
    for command in COMMANDS {
        for help in ["-h", "--help"] {
            let run = stillpoint(dir.path(), &[command, help]);
            assert_eq!(status(&run), 0, "{command}");
            fits(&stdout(&run), command);
        }
    }
    let run = stillpoint(dir.path(), &["--help"]);
    let listed = stdout(&run);
    // By what a person wants, a line each.
    for group in ["Look at", "Record", "Calibrate", "Use a", "Many devices"] {
        assert!(listed.contains(&format!("\n{group}")), "{group}: {listed}");
    }
    for command in COMMANDS {
        let is_its = |line: &&str| line.starts_with(&format!("  {command} "));
        assert_eq!(listed.lines().filter(is_its).count(), 1, "{command}");
    }
}

#[test]
fn every_table_fits_into_80_columns() {
    let (_dir, folder) = folder();
    let effect = "seed = 5\ngrade = \"consumer\"\n[motion.hand_held]\nplacements = 20\n\
                  [effects.gyro_g_sensitivity]\nsize = 3.0\n[[faults]]\nslip = { interval = 12, angle = 5e-3 }\n";
    std::fs::write(folder.join("spec.toml"), effect).unwrap();
    let calls: [&[&str]; 12] = [
        &[
            "simulate",
            "spec.toml",
            "-o",
            "a_session_with_a_rather_long_name",
        ],
        &["calibrate", "good.csv", "-o", "cal.json"],
        &["calibrate", "good.csv", "--method", "joint"],
        &[
            "calibrate",
            "good.csv",
            "a_session_with_a_rather_long_name",
            "--force-device",
        ],
        &["segment", "good.csv"],
        &["info", "good.csv", "a_session_with_a_rather_long_name"],
        &[
            "evaluate",
            "good.csv",
            "--calibration",
            "a_rather_long_name_of_a_calibration=cal.json",
        ],
        &[
            "bias",
            "cal.json",
            "good.csv",
            "--accelerometer",
            "--no-gyroscope",
        ],
        &["allan", "good.csv", "--rest", "0,19"],
        &["discover", "a_session_with_a_rather_long_name"],
        &[
            "discover",
            "good.csv",
            "--validation",
            "a_session_with_a_rather_long_name",
            "--force-device",
        ],
        &["effects"],
    ];
    for call in calls {
        for more in [&[][..], &["-v", "--force"]] {
            // What lists what there is has no more to say, and nothing to replace.
            let takes_force = !more.is_empty() && !["info", "effects"].contains(&call[0]);
            let more = if takes_force {
                more
            } else {
                &more[..more.len().min(1)]
            };
            let run = stillpoint(&folder, &[call, more].concat());
            assert!(!stdout(&run).is_empty(), "{call:?}: {}", stderr(&run));
            fits(&stdout(&run), &call.join(" "));
        }
    }
}

#[test]
fn a_file_alone_is_said_to_be_what_it_is_with_the_next_command() {
    let (_dir, folder) = folder();
    let run = stillpoint(&folder, &["good.csv"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    assert!(stdout(&run).contains("stillpoint calibrate good.csv -o cal.json"));
    let info = stillpoint(&folder, &["info", "good.csv"]);
    assert_eq!(run.stdout, info.stdout);
    assert_eq!(
        status(&stillpoint(
            &folder,
            &["calibrate", "good.csv", "-o", "cal.json"]
        )),
        0
    );
    let run = stillpoint(&folder, &["cal.json"]);
    let said = stdout(&run);
    assert!(
        said.contains("a calibration") && said.contains("stillpoint apply cal.json"),
        "{said}"
    );
    assert_eq!(status(&stillpoint(&folder, &["nothing.csv"])), 2);
}

#[test]
fn quiet_says_nothing_but_results_and_errors_and_results_stay_the_same() {
    let (_dir, folder) = folder();
    let loud = stillpoint(&folder, &["calibrate", "good.csv", "--json"]);
    assert!(stderr(&loud).contains("warning:"), "{}", stderr(&loud));
    let quiet = stillpoint(&folder, &["-q", "calibrate", "good.csv", "--json"]);
    assert_eq!(stderr(&quiet), "");
    assert_eq!(loud.stdout, quiet.stdout);
    let refused = stillpoint(&folder, &["segment", "none.csv", "--quiet"]);
    assert!(stderr(&refused).contains("none.csv"));
    assert_eq!(status(&stillpoint(&folder, &["-q", "-v", "effects"])), 2);
}

#[test]
fn colours_come_where_they_are_asked_for() {
    let (_dir, folder) = folder();
    let escapes = |args: &[&str]| stderr(&stillpoint(&folder, args)).contains('\u{1b}');
    assert!(!escapes(&["segment", "none.csv"]));
    assert!(escapes(&["--color", "always", "segment", "none.csv"]));
    assert!(escapes(&["segment", "none.csv", "--color=always"]));
    assert!(!escapes(&["--color", "never", "segment", "none.csv"]));
}

#[test]
fn completions_and_manual_pages_are_written_for_every_command() {
    let dir = tempfile::tempdir().unwrap();
    let run = stillpoint(dir.path(), &["generate", "--completions", "bash"]);
    let script = stdout(&run);
    assert!(COMMANDS.iter().all(|command| script.contains(command)));
    let run = stillpoint(dir.path(), &["generate", "--man", "man1"]);
    assert_eq!(status(&run), 0, "{}", stderr(&run));
    let pages = files(&dir.path().join("man1"));
    assert_eq!(pages.len(), COMMANDS.len() + 1, "{pages:?}");
    let page = std::fs::read_to_string(dir.path().join("man1/stillpoint-calibrate.1")).unwrap();
    assert!(page.contains(".TH") && page.contains("gravity"));
}
