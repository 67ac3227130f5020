//! Limits: of memory, of time, of what messages quote; and what `--json` prints on failure.

use std::fmt::Write as _;

use crate::common::{folder, json, status, stderr, stillpoint};

#[test]
fn on_failure_json_is_one_error_object() {
    let (_dir, folder) = folder();
    let bad = "t,ax,ay,az\n0,1,2,9.8\n0.01,1,x2,9.8\n0.02,1,2,9.8\n";
    std::fs::write(folder.join("bad.csv"), bad).unwrap();
    std::fs::write(folder.join("spec.toml"), "seed = 1\nrat = 100\n").unwrap();
    let error = |args: &[&str]| {
        let run = stillpoint(&folder, args);
        let error = json(&run)["error"].clone();
        assert_eq!(error["exit"], status(&run), "{args:?}");
        let said = stderr(&run);
        assert!(
            said.contains(error["message"].as_str().unwrap().lines().next().unwrap()),
            "{said}"
        );
        assert!(
            error["next"].as_str().is_some_and(|next| !next.is_empty()),
            "{error}"
        );
        error
    };
    let found = error(&["segment", "bad.csv", "--json"]);
    assert_eq!(
        (&found["kind"], &found["file"]),
        (&"input".into(), &"bad.csv".into())
    );
    assert_eq!((&found["line"], &found["column"]), (&3.into(), &8.into()));
    let found = error(&["segment", "none.csv", "--json"]);
    assert_eq!(
        (&found["kind"], &found["file"]),
        (&"input".into(), &"none.csv".into())
    );
    assert!(found["line"].is_null());
    assert_eq!(error(&["segment", "--json", "--nonsense"])["kind"], "usage");
    assert_eq!(
        error(&["calibrate", "good.csv", "--json", "--gravity", "nan"])["kind"],
        "usage"
    );
    let found = error(&["calibrate", "good.csv", "--json", "--min-static", "500"]);
    assert_eq!(found["kind"], "not_enough_information");
    // Nothing but the document that was asked for where the name stands behind `--`.
    let run = stillpoint(&folder, &["segment", "--", "--json"]);
    assert!(status(&run) == 3 && run.stdout.is_empty());
}

#[test]
fn options_without_sense_are_wrong_calls() {
    let (_dir, folder) = folder();
    std::fs::write(folder.join("means.csv"), "ax,ay,az\n0,0,9.8\n").unwrap();
    let calls: [&[&str]; 9] = [
        &["calibrate", "good.csv", "--gravity", "nan"],
        &["evaluate", "good.csv", "--gravity", "980"],
        &["segment", "good.csv", "--gravity", "inf"],
        &["calibrate", "good.csv", "--nominal-rate", "1e-300"],
        &["calibrate", "good.csv", "--nominal-rate", "1e300"],
        &["calibrate", "good.csv", "--first-order"],
        &[
            "calibrate",
            "good.csv",
            "--method",
            "six-position",
            "--sections",
            "means.csv",
        ],
        &[
            "calibrate",
            "good.csv",
            "--method",
            "six-position",
            "--static-means",
            "means.csv",
        ],
        &[
            "calibrate",
            "good.csv",
            "--method",
            "joint",
            "--static-means",
            "means.csv",
        ],
    ];
    for call in calls {
        let run = stillpoint(&folder, call);
        assert_eq!(status(&run), 2, "{call:?}: {}", stderr(&run));
        assert!(run.stdout.is_empty());
    }
}

#[test]
fn no_message_is_longer_than_a_person_reads() {
    let (_dir, folder) = folder();
    let names: Vec<String> = (0..100_000).map(|k| format!("col{k}")).collect();
    let ones = vec!["1"; 100_000].join(",");
    std::fs::write(
        folder.join("names.csv"),
        format!("{}\n{ones}\n", names.join(",")),
    )
    .unwrap();
    std::fs::write(
        folder.join("line.csv"),
        format!("{}\n1,2,3\n", "x".repeat(900_000)),
    )
    .unwrap();
    let key = "k".repeat(500_000);
    std::fs::write(folder.join("key.toml"), format!("{key} = 1\n")).unwrap();
    std::fs::write(
        folder.join("cal.json"),
        format!("{{\"schema\": \"{key}\"}}"),
    )
    .unwrap();
    let option = "y".repeat(100_000);
    let calls: [&[&str]; 6] = [
        &["segment", "names.csv", "--json"],
        &["segment", "line.csv", "--json"],
        &["simulate", "key.toml", "-o", "out"],
        &["apply", "cal.json", "good.csv"],
        &["evaluate", "good.csv", "--json", "--calibration", &option],
        &["effects", "--effect-file", &option],
    ];
    for call in calls {
        let run = stillpoint(&folder, call);
        assert!([2, 3].contains(&status(&run)));
        let said = stderr(&run);
        assert!(said.len() < 5000, "{} bytes: {}", said.len(), &said[..300]);
        assert!(run.stdout.len() < 6000);
        let longest = said
            .split_whitespace()
            .map(|word| word.chars().count())
            .max();
        assert!(longest.unwrap() < 270, "{}", &said[..300]);
    }
}

#[test]
fn a_costly_or_endless_effect_is_refused_or_given_up_by_its_name() {
    let (_dir, folder) = folder();
    let effect = |name: &str, x: &str| {
        let text = format!(
            "[[definitions]]\nname = \"{name}\"\nsensor = \"gyroscope\"\nx = \"{x}\"\n\
             parameters = [{{ name = \"k\", unit = \"\", typical = 1e-2 }}]\n"
        );
        std::fs::write(folder.join(format!("{name}.toml")), text).unwrap();
        let file = format!("{name}.toml");
        stillpoint(
            &folder,
            &[
                "calibrate",
                "good.csv",
                "--effect-file",
                &file,
                "--effects",
                name,
            ],
        )
    };
    let nested = format!("k*{}wx{}", "sin(".repeat(40), ")".repeat(40));
    let refused = effect("gyro_nested", &nested);
    assert_eq!(status(&refused), 3);
    assert!(
        stderr(&refused).contains("at most 160"),
        "{}",
        stderr(&refused)
    );
    let rooted = effect("gyro_rooted", "k*sqrt(8.3 - fx)");
    assert_eq!(status(&rooted), 5);
    assert!(
        stderr(&rooted).contains("gyro_rooted gives no number"),
        "{}",
        stderr(&rooted)
    );
    let wild = effect("gyro_wild", "k*tan(1e9*wx)");
    assert!([0, 5].contains(&status(&wild)));
    if status(&wild) == 5 {
        assert!(stderr(&wild).contains("gyro_wild"), "{}", stderr(&wild));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn little_memory_is_the_fault_of_the_input_never_an_abort() {
    let (_dir, folder) = folder();
    let mut text = String::from("t,ax,ay,az,gx,gy,gz\n");
    for k in 0..200_000 {
        writeln!(
            text,
            "{:.2},0.{k},0.2,9.8,0.01,0.0{k},0.03",
            f64::from(k) * 0.01
        )
        .unwrap();
    }
    std::fs::write(folder.join("long.csv"), text).unwrap();
    for megabytes in [60, 80, 100, 130, 160, 200] {
        for file in ["long.csv", "good.csv"] {
            let script = format!(
                "ulimit -v {}; $STILLPOINT segment {file} --json",
                megabytes * 1024
            );
            let mut shell = std::process::Command::new("sh");
            shell
                .env("STILLPOINT", env!("CARGO_BIN_EXE_stillpoint"))
                .current_dir(&folder);
            let run = shell.args(["-c", &script]).output().unwrap();
            let status = run.status.code();
            let ends = matches!(status, Some(0 | 3 | 4));
            assert!(ends, "{megabytes} MB, {file}: {status:?}: {}", stderr(&run));
        }
    }
}
