//! Outputs: whole or not at all, nothing left behind, no input written over.

use std::path::Path;

use crate::common::{files, folder, json, status, stderr, stillpoint};

#[test]
fn an_existing_file_is_told_from_one_that_cannot_be_written() {
    let (_dir, folder) = folder();
    std::fs::write(folder.join("cal.json"), "precious").unwrap();
    let call =
        |output: &str| stillpoint(&folder, &["calibrate", "good.csv", "--json", "-o", output]);
    let exists = call("cal.json");
    assert_eq!(status(&exists), 6);
    assert_eq!(json(&exists)["error"]["kind"], "output_exists");
    let message = stderr(&exists);
    assert!(
        message.contains("--force") && message.contains("--skip-existing"),
        "{message}"
    );
    let impossible = call("missing/cal.json");
    assert_eq!(status(&impossible), 6);
    assert_eq!(json(&impossible)["error"]["kind"], "output");
    assert_eq!(
        std::fs::read_to_string(folder.join("cal.json")).unwrap(),
        "precious"
    );
}

#[test]
fn skip_existing_ends_at_once_where_all_is_there_and_makes_the_missing_otherwise() {
    let (_dir, folder) = folder();
    let args = ["calibrate", "good.csv", "-o", "cal.json", "--skip-existing"];
    std::fs::write(folder.join("cal.json"), "precious").unwrap();
    let skipped = stillpoint(&folder, &args);
    assert_eq!(status(&skipped), 0, "{}", stderr(&skipped));
    assert!(stderr(&skipped).contains("nothing to do") && skipped.stdout.is_empty());
    let half = stillpoint(&folder, &[&args[..], &["--report", "cal.html"]].concat());
    assert_eq!(status(&half), 0, "{}", stderr(&half));
    assert_eq!(
        std::fs::read_to_string(folder.join("cal.json")).unwrap(),
        "precious"
    );
    assert_eq!(files(&folder), ["cal.html", "cal.json", "good.csv"]);
    let both = stillpoint(&folder, &[&args[..], &["--force"]].concat());
    assert_eq!(status(&both), 2);
}

#[test]
fn no_command_writes_over_any_of_its_inputs() {
    let (_dir, folder) = folder();
    std::fs::write(
        folder.join("acc.csv"),
        "seed = 1\n[motion.still]\nduration = 5.0\n",
    )
    .unwrap();
    std::fs::write(folder.join("means.csv"), "ax,ay,az\n0,0,9.8\n").unwrap();
    std::fs::create_dir(folder.join("phone")).unwrap();
    std::fs::write(folder.join("phone/acc.csv"), "t,ax,ay,az\n0,0,0,9.8\n").unwrap();
    std::fs::write(folder.join("phone/other.csv"), "t\n").unwrap();
    let made = stillpoint(&folder, &["calibrate", "good.csv", "-o", "cal.json"]);
    assert_eq!(status(&made), 0, "{}", stderr(&made));
    let calls: [&[&str]; 8] = [
        &["simulate", "acc.csv", "-o", "."],
        &[
            "reckon",
            "good.csv",
            "--calibration",
            "mine=cal.json",
            "-o",
            "cal.json",
        ],
        &[
            "calibrate",
            "good.csv",
            "--static-means",
            "means.csv",
            "-o",
            "means.csv",
        ],
        &[
            "calibrate",
            "good.csv",
            "-o",
            "o.json",
            "--report",
            "good.csv",
        ],
        &["bias", "cal.json", "good.csv", "-o", "cal.json"],
        &["apply", "cal.json", "good.csv", "-o", "./good.csv"],
        &["segment", "phone", "-o", "phone/acc.csv"],
        &["discover", "phone", "-o", "phone/other.csv"],
    ];
    let contents = || {
        let names = [
            "acc.csv",
            "means.csv",
            "cal.json",
            "good.csv",
            "phone/acc.csv",
            "phone/other.csv",
        ];
        names.map(|name| std::fs::read(folder.join(name)).unwrap())
    };
    let before = (contents(), files(&folder));
    for call in calls {
        let run = stillpoint(&folder, &[call, &["--force"]].concat());
        assert_eq!(status(&run), 2, "{call:?}: {}", stderr(&run));
        assert!(
            stderr(&run).contains("is the input"),
            "{call:?}: {}",
            stderr(&run)
        );
        assert_eq!((contents(), files(&folder)), before, "{call:?}");
    }
}

#[test]
fn one_file_for_two_outputs_is_refused_however_it_is_spelled() {
    let (_dir, folder) = folder();
    let args = [
        "calibrate",
        "good.csv",
        "-o",
        "o.html",
        "--report",
        "./o.html",
    ];
    let run = stillpoint(&folder, &args);
    assert_eq!(status(&run), 2, "{}", stderr(&run));
    assert!(stderr(&run).contains("two outputs"), "{}", stderr(&run));
    assert_eq!(files(&folder), ["good.csv"]);
}

#[test]
fn a_failed_run_leaves_no_folder_that_it_made() {
    let (_dir, folder) = folder();
    std::fs::write(folder.join("bad.csv"), "t,ax,ay,az\n0,1,2,x\n").unwrap();
    let args = ["segment", "bad.csv", "--plots", "some/where"];
    assert_eq!(status(&stillpoint(&folder, &args)), 3);
    assert_eq!(files(&folder), ["bad.csv", "good.csv"]);
}

#[cfg(unix)]
mod unix {
    use std::fs::Permissions;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::process::{Child, Command, Output, Stdio};
    use std::time::{Duration, Instant};

    use super::*;

    fn mode(path: &Path) -> u32 {
        std::fs::metadata(path).unwrap().mode() & 0o7777
    }

    fn pipe(path: &Path) {
        assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
    }

    /// Starts the program with every signal as usual: what runs in the background may ignore interrupts.
    fn start(folder: &Path, args: &[&str]) -> Child {
        let mut command = Command::new("env");
        command.args(["--default-signal", env!("CARGO_BIN_EXE_stillpoint")]);
        command.current_dir(folder).args(args).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    }

    fn partials(folder: &Path) -> Vec<String> {
        let mut names = files(folder);
        names.retain(|name| name.ends_with(".partial"));
        names
    }

    /// A run that has claimed its output and waits for its input, a pipe that nobody writes to.
    fn waiting(folder: &Path, args: &[&str]) -> Child {
        let child = start(folder, args);
        let begin = Instant::now();
        while partials(folder).is_empty() {
            assert!(
                begin.elapsed() < Duration::from_secs(30),
                "no output claimed"
            );
            std::thread::sleep(Duration::from_millis(5));
        }
        child
    }

    fn kill(child: &Child, signal: &str) {
        let process = child.id().to_string();
        let killed = Command::new("kill").args([signal, &process]).status();
        assert!(killed.unwrap().success());
    }

    fn in_shell(folder: &Path, script: &str) -> Output {
        let mut shell = Command::new("sh");
        shell.current_dir(folder).stdin(Stdio::null());
        shell.env("STILLPOINT", env!("CARGO_BIN_EXE_stillpoint"));
        shell.args(["-c", script]).output().unwrap()
    }

    #[test]
    fn a_pipe_is_read_once_and_to_its_end() {
        let (_dir, folder) = folder();
        let plain = stillpoint(&folder, &["calibrate", "good.csv", "-o", "plain.json"]);
        assert_eq!(status(&plain), 0, "{}", stderr(&plain));
        pipe(&folder.join("pipe.csv"));
        let calls: [&[&str]; 2] = [
            &[
                "calibrate",
                "pipe.csv",
                "-o",
                "o.json",
                "--report",
                "o.html",
                "--force",
            ],
            &[
                "allan", "pipe.csv", "--rest", "0,19", "-o", "o.json", "--force",
            ],
        ];
        for call in calls {
            let child = start(&folder, call);
            // Opened for writing once a reader is there; it would fail where the reader goes early.
            let text = std::fs::read(folder.join("good.csv")).unwrap();
            std::fs::write(folder.join("pipe.csv"), text).unwrap();
            let output = child.wait_with_output().unwrap();
            assert_eq!(status(&output), 0, "{call:?}: {}", stderr(&output));
        }
        assert!(folder.join("o.html").is_file());
        let child = start(
            &folder,
            &["calibrate", "pipe.csv", "-o", "o.json", "--force"],
        );
        let text = std::fs::read(folder.join("good.csv")).unwrap();
        std::fs::write(folder.join("pipe.csv"), text).unwrap();
        assert_eq!(status(&child.wait_with_output().unwrap()), 0);
        let read = |name: &str| {
            let text = std::fs::read_to_string(folder.join(name)).unwrap();
            serde_json::from_str::<serde_json::Value>(&text).unwrap()
        };
        let (piped, plain) = (read("o.json"), read("plain.json"));
        assert_eq!(piped["accelerometer"], plain["accelerometer"]);
        assert_eq!(piped["gyroscope"], plain["gyroscope"]);
    }

    #[test]
    fn planted_links_are_not_followed() {
        let (_dir, folder) = folder();
        std::fs::write(folder.join("victim"), "precious").unwrap();
        let names = [
            ".cal.json.partial",
            ".cal.json.stillpoint-1-aaaaaaaaaa.partial",
        ];
        for name in names {
            symlink("victim", folder.join(name)).unwrap();
        }
        let run = stillpoint(&folder, &["calibrate", "good.csv", "-o", "cal.json"]);
        assert_eq!(status(&run), 0, "{}", stderr(&run));
        assert_eq!(
            std::fs::read_to_string(folder.join("victim")).unwrap(),
            "precious"
        );
        assert!(folder.join("cal.json").is_file() && !folder.join("cal.json").is_symlink());
    }

    #[test]
    fn a_replaced_file_keeps_its_permissions_and_a_new_one_has_the_usual() {
        let (_dir, folder) = folder();
        let args = ["calibrate", "good.csv", "-o", "cal.json", "--force"];
        std::fs::write(folder.join("usual"), "").unwrap();
        assert_eq!(status(&stillpoint(&folder, &args)), 0);
        assert_eq!(mode(&folder.join("cal.json")), mode(&folder.join("usual")));
        for kept in [0o600, 0o640, 0o664] {
            std::fs::set_permissions(folder.join("cal.json"), Permissions::from_mode(kept))
                .unwrap();
            assert_eq!(status(&stillpoint(&folder, &args)), 0);
            assert_eq!(mode(&folder.join("cal.json")), kept);
        }
        std::fs::set_permissions(folder.join("cal.json"), Permissions::from_mode(0o444)).unwrap();
        let run = stillpoint(&folder, &args);
        assert_eq!(status(&run), 6);
        assert!(stderr(&run).contains("write-protected"), "{}", stderr(&run));
    }

    #[test]
    fn a_link_to_a_file_is_written_through_and_one_to_nothing_is_refused() {
        let (_dir, folder) = folder();
        std::fs::create_dir(folder.join("there")).unwrap();
        std::fs::write(folder.join("there/real.json"), "old").unwrap();
        symlink("there/real.json", folder.join("link.json")).unwrap();
        symlink("nowhere/none.json", folder.join("dangling.json")).unwrap();
        let call =
            |output: &str| stillpoint(&folder, &["calibrate", "good.csv", "-o", output, "--force"]);
        assert_eq!(status(&call("link.json")), 0);
        assert!(folder.join("link.json").is_symlink());
        let text = std::fs::read_to_string(folder.join("there/real.json")).unwrap();
        assert!(text.contains("schema"));
        let run = call("dangling.json");
        assert_eq!(status(&run), 6);
        assert!(
            stderr(&run).contains("a link to nothing"),
            "{}",
            stderr(&run)
        );
        assert!(folder.join("dangling.json").is_symlink());
    }

    #[test]
    fn a_second_run_to_one_output_names_the_first_and_a_killed_one_is_cleaned_up_after() {
        let (_dir, folder) = folder();
        pipe(&folder.join("pipe.csv"));
        let mut first = waiting(&folder, &["calibrate", "pipe.csv", "-o", "cal.json"]);
        let second = stillpoint(&folder, &["calibrate", "good.csv", "-o", "cal.json"]);
        assert_eq!(status(&second), 6);
        let named = format!("process {}", first.id());
        assert!(stderr(&second).contains(&named), "{}", stderr(&second));
        kill(&first, "-KILL");
        first.wait().unwrap();
        assert_eq!(partials(&folder).len(), 1);
        // Not only a run to the same output cleans up.
        let other = stillpoint(&folder, &["calibrate", "good.csv", "-o", "other.json"]);
        assert_eq!(status(&other), 0, "{}", stderr(&other));
        assert_eq!(files(&folder), ["good.csv", "other.json", "pipe.csv"]);
    }

    #[test]
    fn an_interrupted_run_leaves_nothing_and_what_was_there() {
        let (_dir, folder) = folder();
        pipe(&folder.join("pipe.csv"));
        std::fs::write(folder.join("cal.json"), "precious").unwrap();
        for signal in ["-TERM", "-HUP", "-INT"] {
            let args = [
                "calibrate",
                "pipe.csv",
                "--force",
                "-o",
                "cal.json",
                "--plots",
                "new/folder",
                "--json",
            ];
            let child = waiting(&folder, &args);
            kill(&child, signal);
            let output = child.wait_with_output().unwrap();
            assert_eq!(status(&output), 130, "{signal}: {}", stderr(&output));
            assert_eq!(json(&output)["error"]["kind"], "interrupted");
            assert_eq!(
                files(&folder),
                ["cal.json", "good.csv", "pipe.csv"],
                "{signal}"
            );
            assert_eq!(
                std::fs::read_to_string(folder.join("cal.json")).unwrap(),
                "precious"
            );
        }
    }

    #[test]
    fn an_interrupted_simulation_leaves_nothing() {
        let (_dir, folder) = folder();
        let spec = "seed = 1\nrate = 1000.0\n[motion.still]\nduration = 20000.0\n";
        std::fs::write(folder.join("spec.toml"), spec).unwrap();
        let child = start(&folder, &["simulate", "spec.toml", "-o", "out"]);
        let begin = Instant::now();
        while !folder.join("out").is_dir() || partials(&folder.join("out")).len() < 3 {
            assert!(begin.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(2));
        }
        kill(&child, "-TERM");
        assert_eq!(status(&child.wait_with_output().unwrap()), 130);
        assert_eq!(files(&folder), ["good.csv", "spec.toml"]);
    }

    #[test]
    fn a_hangup_that_is_ignored_stays_ignored() {
        let (_dir, folder) = folder();
        pipe(&folder.join("pipe.csv"));
        let script = "trap '' HUP; $STILLPOINT segment pipe.csv --json & \
                      sleep 1; kill -HUP $!; cat good.csv > pipe.csv; wait $!";
        let output = in_shell(&folder, script);
        assert_eq!(status(&output), 0, "{}", stderr(&output));
    }

    #[test]
    fn a_limit_on_file_sizes_leaves_nothing_and_what_was_there() {
        let (_dir, folder) = folder();
        std::fs::write(folder.join("cal.json"), "precious").unwrap();
        let calibrate = "ulimit -f 1; $STILLPOINT calibrate good.csv --force -o cal.json --json";
        let simulate =
            "ulimit -f 8; printf 'seed = 1\n' > spec.toml; $STILLPOINT simulate spec.toml -o out";
        let output = in_shell(&folder, calibrate);
        assert_eq!(status(&output), 6, "{}", stderr(&output));
        let said = json(&output);
        let next = said["error"]["next"].as_str().unwrap();
        assert!(
            next.ends_with("raise the limit on file sizes (ulimit -f)"),
            "{next}"
        );
        assert_eq!(status(&in_shell(&folder, simulate)), 6);
        assert_eq!(files(&folder), ["cal.json", "good.csv", "spec.toml"]);
        assert_eq!(
            std::fs::read_to_string(folder.join("cal.json")).unwrap(),
            "precious"
        );
    }

    #[test]
    fn a_closed_standard_error_is_no_error() {
        let (_dir, folder) = folder();
        let output = in_shell(&folder, "$STILLPOINT segment missing.csv 2>&-");
        assert_eq!(status(&output), 3);
        let output = in_shell(&folder, "$STILLPOINT segment good.csv --json 2>/dev/full");
        assert_eq!(status(&output), 0);
    }

    #[test]
    fn of_twelve_runs_to_one_output_some_are_refused_and_what_is_there_is_whole() {
        let (_dir, folder) = folder();
        let args = ["segment", "good.csv", "-o", "o.json", "--force"];
        let runs: Vec<Child> = (0..12).map(|_| start(&folder, &args)).collect();
        let mut done = 0;
        for run in runs {
            let output = run.wait_with_output().unwrap();
            match status(&output) {
                0 => done += 1,
                status => assert!(
                    status == 6 && stderr(&output).contains("another run"),
                    "{}",
                    stderr(&output)
                ),
            }
        }
        assert!(done > 0);
        let text = std::fs::read_to_string(folder.join("o.json")).unwrap();
        assert!(serde_json::from_str::<serde_json::Value>(&text).is_ok());
        assert_eq!(files(&folder), ["good.csv", "o.json"]);
    }
}

#[test]
fn the_page_for_browsers_is_written_or_the_build_says_where_to_get_it() {
    let (_dir, folder) = folder();
    let run = stillpoint(&folder, &["page", "-o", "page.html"]);
    let page = std::fs::read_to_string(folder.join("page.html"));
    if cfg!(feature = "page") {
        assert_eq!(status(&run), 0);
        let page = page.unwrap();
        assert!(page.starts_with("<!doctype html>") && page.contains("wasm-unsafe-eval"));
    } else {
        assert_eq!(status(&run), 2);
        assert!(stderr(&run).contains("cli/web/build"), "{}", stderr(&run));
        assert!(page.is_err());
    }
}
