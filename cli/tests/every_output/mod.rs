//! Every option of every command that writes a file, and every one that reads one: no input is written over, nothing that stands
//! in the way is harmed, and what cannot be written is found before anything is read.
#![cfg(unix)]

mod calls;

use std::collections::BTreeMap;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::common::{files, status, stderr, stillpoint};
use calls::{CALLS, WITHOUT_INPUT, furnished};

/// Every file below the folder with its bytes; a link by where it leads.
fn everything(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let kind = std::fs::symlink_metadata(&path).unwrap().file_type();
            let content = match () {
                () if kind.is_dir() => {
                    folders.push(path);
                    continue;
                }
                () if kind.is_symlink() => std::fs::read_link(&path)
                    .unwrap()
                    .into_os_string()
                    .into_encoded_bytes(),
                () if kind.is_fifo() => b"pipe".to_vec(),
                () => std::fs::read(&path).unwrap(),
            };
            found.insert(path, content);
        }
    }
    found
}

/// The option's value for an output's name: the folder where the program names the file.
fn value(name: &str) -> &str {
    name.split_once('/').map_or(name, |(folder, _)| folder)
}

fn run(folder: &Path, call: &[&str], output: (&str, &str), force: bool) -> Output {
    let mut command = Command::new("timeout");
    command
        .args(["60", env!("CARGO_BIN_EXE_stillpoint")])
        .args(call);
    command.args([output.0, value(output.1)]);
    // What a batch replaces it has its own words for.
    if force {
        command.arg("--force");
    }
    command
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// Removes what was put in the way.
fn clear(folder: &Path, name: &str) {
    match name.split_once('/') {
        Some((made, _)) => drop(std::fs::remove_dir_all(folder.join(made))),
        None => drop(std::fs::remove_file(folder.join(name))),
    }
}

fn place_of(folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    path
}

#[test]
fn no_output_is_written_over_an_input_through_a_link_of_either_kind() {
    let (_dir, folder) = furnished();
    let before = everything(&folder);
    for (call, inputs, outputs) in CALLS {
        for output in outputs {
            for (k, input) in inputs.iter().enumerate() {
                for hard in [false, true].into_iter().skip(usize::from(k > 0)) {
                    let place = place_of(&folder, output.1);
                    match hard {
                        true => std::fs::hard_link(folder.join(input), &place).unwrap(),
                        false => symlink(folder.join(input), &place).unwrap(),
                    }
                    let run = run(&folder, call, *output, true);
                    let said = stderr(&run);
                    let told = format!("{call:?} {output:?} {input} {hard}: {said}");
                    assert_eq!(status(&run), 2, "{told}");
                    assert!(said.contains("is the input"), "{told}");
                    clear(&folder, output.1);
                }
            }
        }
    }
    assert!(everything(&folder) == before);
}

#[test]
fn no_output_is_written_over_an_input_by_its_own_name() {
    let (_dir, folder) = furnished();
    let before = everything(&folder);
    for (call, inputs, outputs) in CALLS {
        for (option, name) in outputs.iter().filter(|(_, name)| !name.contains('/')) {
            let alike = |input: &&&str| Path::new(input).extension() == Path::new(name).extension();
            for input in inputs.iter().filter(alike) {
                // A name with a folder is none that the program makes.
                let own = [*option, input, "--force"];
                let run = stillpoint(&folder, &[call, &own].concat());
                assert_eq!(status(&run), 2, "{call:?} {own:?}: {}", stderr(&run));
            }
        }
    }
    assert!(everything(&folder) == before);
}

#[test]
fn what_cannot_be_written_is_found_before_anything_is_read_and_is_not_harmed() {
    let (_dir, folder) = furnished();
    std::fs::write(folder.join("plain"), "").unwrap();
    // A command that reads its recording first waits here for ever.
    std::fs::remove_file(folder.join("good.csv")).unwrap();
    let fifo = |name: &str| {
        let made = Command::new("mkfifo").arg(folder.join(name)).status();
        assert!(made.unwrap().success());
    };
    fifo("good.csv");
    let before = everything(&folder);
    let calls = CALLS
        .iter()
        .flat_map(|(call, _, outputs)| outputs.iter().map(move |o| (*call, *o)));
    let calls = calls.chain(WITHOUT_INPUT.map(|(call, option, name)| (call, (option, name))));
    for (call, output) in calls {
        let tried = |what: &str, call: &[&str], output: (&str, &str), force: bool| {
            let run = run(&folder, call, output, force);
            assert_eq!(
                status(&run),
                6,
                "{what}: {call:?} {output:?}: {}",
                stderr(&run)
            );
        };
        let is_folder = output.1.contains('/');
        if is_folder {
            tried("below a file", call, (output.0, "plain/below"), false);
        }
        if !is_folder {
            let name = format!("means.csv/{}", output.1);
            let run = stillpoint(&folder, &[call, &[output.0, &name]].concat());
            assert_eq!(
                status(&run),
                6,
                "below a file: {call:?} {output:?}: {}",
                stderr(&run)
            );
        }
        if call[0] == "batch" && is_folder {
            continue;
        }
        let place = place_of(&folder, output.1);
        fifo(output.1);
        tried("a pipe", call, output, true);
        assert!(std::fs::metadata(&place).unwrap().file_type().is_fifo());
        std::fs::remove_file(&place).unwrap();
        std::fs::create_dir(&place).unwrap();
        tried("a folder", call, output, true);
        std::fs::remove_dir(&place).unwrap();
        symlink("nowhere", &place).unwrap();
        tried("a link to nothing", call, output, false);
        assert!(place.is_symlink());
        clear(&folder, output.1);
    }
    assert!(everything(&folder) == before);
}

#[test]
fn links_that_are_planted_where_the_program_names_the_file_have_no_victim() {
    let (_dir, folder) = furnished();
    let victim = folder.join("victim");
    std::fs::write(&victim, "precious").unwrap();
    let calls: [(&[&str], &str, &[&str]); 6] = [
        (
            &["simulate", "spec.toml", "-o", "made"],
            "made",
            &["acc.csv", "gyro.csv", "truth.json"],
        ),
        (
            &["convert", "good.csv", "-o", "made"],
            "made",
            &["acc.csv", "gyro.csv"],
        ),
        (
            &["segment", "good.csv", "--plots", "made"],
            "made",
            &["rests.svg", "rests.png"],
        ),
        (
            &["export", "cal.json", "--to", "imu_tk", "-o", "made"],
            "made",
            &["acc.calib", "gyro.calib"],
        ),
        (
            &["generate", "--man", "made"],
            "made",
            &["stillpoint.1", "stillpoint-live.1"],
        ),
        (
            &["batch", "devices", "-o", "made"],
            "made",
            &[
                "part-1-of-1.jsonl",
                "timings-1-of-1.jsonl",
                "devices/d/cal.json",
                "devices/d/record.json",
            ],
        ),
    ];
    for (call, made, names) in calls {
        for name in names {
            let place = place_of(&folder, &format!("{made}/{name}"));
            symlink(&victim, place).unwrap();
        }
        let run = stillpoint(&folder, &[call, &["--force"]].concat());
        assert!([0, 1].contains(&status(&run)), "{call:?}: {}", stderr(&run));
        for name in names {
            let place = folder.join(made).join(name);
            assert!(place.is_file() && !place.is_symlink(), "{call:?} {name}");
        }
        assert_eq!(std::fs::read(&victim).unwrap(), b"precious", "{call:?}");
        std::fs::remove_dir_all(folder.join(made)).unwrap();
    }
    // A folder of a device that leads elsewhere is refused.
    std::fs::create_dir_all(folder.join("made/devices")).unwrap();
    std::fs::create_dir(folder.join("elsewhere")).unwrap();
    std::fs::write(folder.join("elsewhere/cal.json"), "precious").unwrap();
    symlink(folder.join("elsewhere"), folder.join("made/devices/d")).unwrap();
    let run = stillpoint(&folder, &["batch", "devices", "-o", "made"]);
    assert_eq!(status(&run), 6, "{}", stderr(&run));
    assert_eq!(
        std::fs::read(folder.join("elsewhere/cal.json")).unwrap(),
        b"precious"
    );
    assert_eq!(files(&folder.join("elsewhere")), ["cal.json"]);
}

#[test]
fn a_live_session_writes_over_nothing_that_it_reads() {
    let (_dir, folder) = furnished();
    symlink("good.csv", folder.join("link.csv")).unwrap();
    std::fs::hard_link(folder.join("good.csv"), folder.join("hard.csv")).unwrap();
    std::fs::create_dir(folder.join("plots")).unwrap();
    let before = everything(&folder);
    let calls: [(&[&str], i32); 10] = [
        (&["--events", "good.csv"], 2),
        (&["--events", "link.csv"], 2),
        (&["--events", "hard.csv"], 2),
        (&["-o", "good.csv", "--force"], 2),
        (&["-o", "link.csv", "--force"], 2),
        (&["-o", "hard.csv", "--force"], 2),
        (&["--events", "e", "-o", "e", "--force"], 2),
        (&["--out", "s", "-o", "s/lines.txt"], 2),
        (&["-o", "missing/cal.json"], 6),
        (&["--", "--report", "hard.csv"], 2),
    ];
    for (options, expected) in calls {
        let call = [&["live", "good.csv"], options].concat();
        let run = stillpoint(&folder, &call);
        assert_eq!(status(&run), expected, "{call:?}: {}", stderr(&run));
        assert!(everything(&folder) == before, "{call:?}");
    }
    let text = std::fs::File::open(folder.join("good.csv")).unwrap();
    let from_input = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .args(["live", "-", "-o", "hard.csv", "--force"])
        .current_dir(&folder)
        .stdin(text)
        .output()
        .unwrap();
    assert_eq!(status(&from_input), 2, "{}", stderr(&from_input));
    assert!(everything(&folder) == before);
}

/// Words of a call's help that name a file or a folder, with their option.
fn named_files(help: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for line in help.lines() {
        let mut words = line.split_whitespace().filter(|word| *word != "-o,");
        let (Some(option), Some(what)) = (words.next(), words.next()) else {
            continue;
        };
        let names = ["FILE", "DIR", "OUT", "RECORDING", "PATH"];
        if option.starts_with('-')
            && what.starts_with('<')
            && names.iter().any(|name| what.contains(name))
        {
            found.push((option.to_owned(), what.to_owned()));
        }
    }
    found
}

#[test]
fn the_tables_above_have_every_option_that_names_a_file() {
    let dir = tempfile::tempdir().unwrap();
    let help = |command: &[&str]| {
        let run = stillpoint(dir.path(), &[command, &["--help"]].concat());
        String::from_utf8(run.stdout).unwrap()
    };
    let whole = help(&[]);
    let listed = whole.split("\nLook at").nth(1).unwrap().lines().skip(1);
    let names = listed.take_while(|line| !line.trim().is_empty());
    let names = names.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let mut commands: Vec<Vec<&str>> = names
        .map(|line| vec![line.split_whitespace().next().unwrap()])
        .collect();
    commands.extend([
        vec!["batch", "merge"],
        vec!["batch", "prior"],
        vec!["generate"],
    ]);
    assert!(commands.len() > 20, "{commands:?}");
    for command in commands {
        // It has a test of its own.
        if command == ["live"] {
            continue;
        }
        for (option, what) in named_files(&help(&command)) {
            let of = |call: &&[&str]| call.starts_with(&command);
            let read = CALLS
                .iter()
                .any(|(call, ..)| of(call) && call.contains(&option.as_str()));
            let written = CALLS
                .iter()
                .any(|(call, _, outputs)| of(call) && outputs.iter().any(|o| o.0 == option));
            let alone = WITHOUT_INPUT
                .iter()
                .any(|(call, own, _)| of(call) && *own == option);
            // `effects` writes nothing, and `page` nothing in a build that carries none.
            let harmless = command == ["effects"] || command == ["page"] && !cfg!(feature = "page");
            assert!(
                read || written || alone || harmless,
                "{command:?} {option} {what}"
            );
        }
    }
}
