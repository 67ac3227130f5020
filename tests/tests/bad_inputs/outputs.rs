//! Cases 120 to 142: outputs, the environment, configuration and what runs beside.

use std::os::unix::fs::{PermissionsExt, symlink};

use serde_json::Value;

use stillpoint_tests::needed_data::skipped;

use super::bench::{Bench, Run};
use super::device::{csv, good};

fn bench() -> Bench {
    Bench::with("r.csv", csv(good()))
}

/// A folder with `r.csv` and its calibration `cal.json`.
fn calibrated() -> Bench {
    let bench = bench();
    bench
        .run(&["calibrate", "r.csv", "-o", "cal.json"])
        .ends(0)
        .changes(&["cal.json"]);
    bench
}

#[test]
fn case_120_an_output_that_exists() {
    let bench = bench();
    bench.write("cal.json", "precious");
    let path = bench.path("cal.json");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o600)).unwrap();
    let run = bench.run(&["calibrate", "r.csv", "-o", "cal.json"]);
    run.ends(6).says(&["cal.json", "--force"]).changes(&[]);
    bench
        .run(&["calibrate", "r.csv", "-o", "cal.json", "--force"])
        .ends(0);
    let mode = std::fs::metadata(&path).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
}

#[test]
fn case_121_a_link_in_the_way_of_a_temporary_name_is_not_followed() {
    let bench = bench();
    bench.write("victim", "precious");
    symlink("victim", bench.path(".cal.json.partial")).unwrap();
    bench.run(&["calibrate", "r.csv", "-o", "cal.json"]);
    let kept = std::fs::read_to_string(bench.path("victim")).unwrap();
    assert_eq!(kept, "precious");
}

#[test]
fn case_121_an_output_that_is_an_input() {
    let bench = bench();
    symlink("r.csv", bench.path("link.csv")).unwrap();
    std::fs::hard_link(bench.path("r.csv"), bench.path("twin.csv")).unwrap();
    for target in ["r.csv", "link.csv", "twin.csv"] {
        let run = bench.run(&["calibrate", "r.csv", "-o", target, "--force"]);
        run.ends(2).changes(&[]);
    }
    bench.write("acc.csv", "seed = 7\n");
    let run = bench.run(&["simulate", "acc.csv", "-o", ".", "--force"]);
    run.ends(2).changes(&[]);
}

#[test]
fn case_126_an_interrupt_leaves_nothing() {
    let bench = bench();
    for signal in ["-INT", "-TERM", "-HUP"] {
        // What runs in the background may ignore interrupts: every signal as usual.
        let mut run = std::process::Command::new("env")
            .current_dir(bench.path(""))
            .args(["--default-signal", env!("CARGO_BIN_EXE_stillpoint")])
            .args(["calibrate", "-", "-o", "cal.json"])
            .stdin(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        let input = run.stdin.take();
        std::thread::sleep(std::time::Duration::from_millis(300));
        let id = run.id().to_string();
        let sent = std::process::Command::new("kill")
            .args([signal, &id])
            .status();
        assert!(sent.unwrap().success());
        let status = run.wait().unwrap();
        drop(input);
        assert_eq!(status.code(), Some(130), "{signal}");
        let names = std::fs::read_dir(bench.path("")).unwrap();
        let names: Vec<_> = names.map(|e| e.unwrap().file_name()).collect();
        assert_eq!(names, ["r.csv"], "{signal}");
    }
}

#[test]
fn case_134_a_spec_with_an_unknown_key() {
    let bench = Bench::with("spec.toml", "seed = 1\nrat = 100\n");
    let run = bench.run(&["simulate", "spec.toml", "-o", "out"]);
    run.ends(2)
        .says(&["spec.toml:2:1", "`rat`", "`rate`"])
        .changes(&[]);
    bench.write("spec.toml", "seed = 1\nrate = \"fast\"\n");
    let run = bench.run(&["simulate", "spec.toml", "-o", "out"]);
    run.ends(2).says(&["spec.toml:2"]).changes(&[]);
}

#[test]
fn case_135_a_file_of_a_future_version() {
    let bench = calibrated();
    let text = std::fs::read_to_string(bench.path("cal.json")).unwrap();
    bench.write("new.json", text.replace("calibration/1", "calibration/9"));
    let run = bench.run(&["apply", "new.json", "r.csv", "-o", "c.csv"]);
    run.ends(2)
        .says(&["calibration/9", "calibration/1"])
        .changes(&[]);
}

#[test]
fn case_122_a_folder_that_cannot_be_written() {
    let bench = bench();
    let run = bench.run(&["calibrate", "r.csv", "-o", "/proc/cal.json"]);
    run.ends(6).says(&["/proc/cal.json"]);
    bench.write("file", "no folder");
    let run = bench.run(&["calibrate", "r.csv", "-o", "file/cal.json"]);
    run.ends(6).says(&["file"]);
}

/// The program under limits that the shell sets.
fn limited(bench: &Bench, limit: &str, args: &[&str]) -> Run {
    let mut command = std::process::Command::new("bash");
    command
        .current_dir(bench.path(""))
        .arg("-c")
        .arg(format!("{limit}; exec \"$0\" \"$@\""))
        .arg(env!("CARGO_BIN_EXE_stillpoint"))
        .args(args);
    bench.watch(command)
}

#[test]
fn case_123_a_limit_on_file_sizes() {
    let bench = calibrated();
    bench.write("c.csv", "old");
    let args = ["apply", "cal.json", "r.csv", "-o", "c.csv", "--force"];
    limited(&bench, "ulimit -f 100", &args).ends(6).changes(&[]);
}

#[test]
fn case_123_a_full_disk() {
    let bench = calibrated();
    let disk = bench.path("disk");
    std::fs::create_dir(&disk).unwrap();
    let mount = |args: &[&str]| {
        let mut command = std::process::Command::new(args[0]);
        command
            .args(&args[1..])
            .arg(&disk)
            .stderr(std::process::Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    if !mount(&["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs"]) {
        return skipped("a full disk needs the right to mount one (root)");
    }
    bench.write("disk/c.csv", "old");
    bench.write(
        "spec.toml",
        "seed = 1\n[motion.hand_held]\nplacements = 12\n",
    );
    let apply = ["apply", "cal.json", "r.csv", "-o", "disk/c.csv", "--force"];
    let full = bench.run(&apply);
    let folder = bench.run(&["apply", "cal.json", "r.csv", "-o", "disk/new"]);
    let simulated = bench.run(&["simulate", "spec.toml", "-o", "disk/session"]);
    let names = std::fs::read_dir(&disk).unwrap();
    let left: Vec<_> = names.map(|entry| entry.unwrap().file_name()).collect();
    let old = std::fs::read_to_string(disk.join("c.csv"));
    assert!(mount(&["umount"]), "still mounted: {}", disk.display());
    full.ends(6).says(&["c.csv"]).changes(&[]);
    folder.ends(6).changes(&[]);
    simulated.ends(6).changes(&[]);
    assert_eq!(old.unwrap(), "old");
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn case_124_what_a_killed_run_left_is_ignored() {
    let bench = bench();
    bench.write(".cal.json.partial", "half of a file");
    bench.write(".cal.jsonAbCdEf.partial", "half of a file");
    bench.run(&["calibrate", "r.csv", "-o", "cal.json"]).ends(0);
    let text = std::fs::read_to_string(bench.path("cal.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap();
}

#[test]
fn case_125_two_runs_to_one_output() {
    let bench = bench();
    let mut runs = Vec::new();
    for _ in 0..12 {
        let args = ["calibrate", "r.csv", "-o", "cal.json"];
        runs.push(bench.command(&args).spawn().unwrap());
    }
    let codes: Vec<_> = runs
        .iter_mut()
        .map(|run| run.wait().unwrap().code())
        .collect();
    assert!(codes.contains(&Some(0)), "{codes:?}");
    assert!(codes.iter().all(|c| matches!(c, Some(0 | 6))), "{codes:?}");
    let text = std::fs::read_to_string(bench.path("cal.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap();
}

#[test]
fn case_127_a_reader_that_closes_the_pipe() {
    let bench = calibrated();
    let program = env!("CARGO_BIN_EXE_stillpoint");
    let line = format!(
        "set -o pipefail; '{program}' apply cal.json r.csv | head -1 >/dev/null; echo ${{PIPESTATUS[0]}}"
    );
    let mut command = std::process::Command::new("bash");
    command.current_dir(bench.path("")).args(["-c", &line]);
    let run = bench.watch(command);
    assert_eq!((run.stdout.trim(), run.stderr.as_str()), ("0", ""));
}

#[test]
fn case_128_nothing_on_standard_input() {
    let run = bench().run(&["calibrate", "-"]);
    run.ends(2).says(&["standard input is empty"]);
}

#[test]
fn case_129_a_device_as_output() {
    let bench = bench();
    for target in ["/dev/full", "/dev/null"] {
        let run = bench.run(&["calibrate", "r.csv", "-o", target, "--force"]);
        run.ends(6).says(&[target]);
    }
}

#[test]
fn case_130_a_file_system_that_does_not_rename() {
    let bench = calibrated();
    bench.write("c.csv", "precious");
    // A name that something is mounted on cannot be renamed over, whoever asks.
    let program = env!("CARGO_BIN_EXE_stillpoint");
    let mounted =
        format!("mount --bind c.csv c.csv && exec {program} apply cal.json r.csv -o c.csv --force");
    let within = |script: &str| {
        let mut command = std::process::Command::new("unshare");
        command
            .args(["--user", "--map-root-user", "--mount", "sh", "-c", script])
            .current_dir(bench.path(""));
        command
    };
    let allowed = within("mount --bind c.csv c.csv").output();
    if !allowed.is_ok_and(|output| output.status.success()) {
        return skipped("a mount needs unshare of util-linux and user namespaces");
    }
    let run = bench.watch(within(&mounted));
    run.ends(6).says(&["c.csv", "again"]).changes(&[]);
}

#[test]
fn case_131_markup_in_names_stays_text() {
    let bench = Bench::new();
    let name = "<img src=x onerror=alert(1)>.csv";
    bench.write(name, csv(good()));
    bench
        .run(&["calibrate", name, "--report", "r.html"])
        .ends(0);
    let page = std::fs::read_to_string(bench.path("r.html")).unwrap();
    assert!(!page.contains("<img src=x"), "markup in the page");
    assert!(page.contains("&#60;img"), "the name is not shown");
}

#[test]
fn case_132_escape_sequences_in_names_are_shown_escaped() {
    let bench = Bench::new();
    let name = "\u{1b}[31mred\u{7}.csv";
    bench.write(name, "no recording");
    // `Run` asserts that no control character passes.
    bench.run(&["calibrate", name]).ends(3).says(&["red"]);
}

#[test]
fn case_138_the_environment_does_not_matter() {
    let bench = bench();
    let usual = bench.run(&["calibrate", "r.csv", "--json"]);
    for (key, value) in [
        ("LANG", "de_DE.UTF-8"),
        ("LC_ALL", "C"),
        ("TZ", "Asia/Kathmandu"),
        ("HOME", "/nonexistent"),
        ("RAYON_NUM_THREADS", "1"),
        ("RAYON_NUM_THREADS", "64"),
        ("COLUMNS", "100000"),
    ] {
        let mut command = bench.command(&["calibrate", "r.csv", "--json"]);
        command.env(key, value);
        let run = bench.watch(command);
        assert_eq!(run.stdout, usual.stdout, "{key}={value}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn case_139_a_limit_on_memory_is_an_error_not_an_abort() {
    let bench = Bench::new();
    let mut rows = Vec::new();
    for copy in 0..30 {
        rows.extend(good().iter().map(|row| {
            let mut row = *row;
            row[0] += 200.0 * f64::from(copy);
            row
        }));
    }
    bench.write("r.csv", csv(&rows));
    // A development build is 50 MB by itself.
    for kilobytes in [60_000, 80_000, 120_000] {
        let run = limited(
            &bench,
            &format!("ulimit -v {kilobytes}"),
            &["segment", "r.csv"],
        );
        assert!(matches!(run.status, Some(0 | 3)), "{kilobytes}: {run:#?}");
    }
}

#[test]
fn case_140_clocks_in_1970_and_2106_change_nothing() {
    let at = |start: f64| {
        let rows: Vec<_> = good()
            .iter()
            .map(|row| {
                let mut row = *row;
                row[0] += start;
                row
            })
            .collect();
        let bench = Bench::with("r.csv", csv(&rows));
        let run = bench.run(&["calibrate", "r.csv", "--json"]);
        let bias = run.ends(0).json()["gyroscope"]["bias"][0].clone();
        bias.as_f64().unwrap()
    };
    let (early, late) = (at(0.0), at(4_294_967_296.0));
    assert!((early - late).abs() < 1e-7, "{early} {late}");
}

#[test]
fn case_142_an_effect_that_gives_no_number_or_takes_forever() {
    let bench = bench();
    let deep = format!("{}wx{}", "sin(".repeat(40), ")".repeat(40));
    for (name, formula) in [
        ("nan", "k * sqrt(-1 - wx * wx)"),
        ("deep", &format!("k * {deep}")),
    ] {
        bench.write(
            "e.toml",
            format!(
                "[[definitions]]\nname = \"gyro_{name}\"\nsensor = \"gyroscope\"\nx = \"{formula}\"\n\
                 parameters = [{{ name = \"k\", unit = \"rad/s\", typical = 1e-2 }}]\n"
            ),
        );
        let effect = format!("gyro_{name}");
        let args = [
            "calibrate",
            "r.csv",
            "--effect-file",
            "e.toml",
            "--effects",
            &effect,
        ];
        let run = bench.run(&args);
        assert!(matches!(run.status, Some(0 | 2..=5)), "{run:#?}");
        if name == "nan" {
            assert_ne!(run.status, Some(0), "{run:#?}");
            run.says(&["e.toml", "NaN"]);
        }
    }
}
