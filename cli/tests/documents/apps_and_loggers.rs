//! Every line of the manual's table of apps and loggers, run on a file as that program writes it.

use std::process::Command;

use stillpoint_tests::layouts::{Samples, layouts};

const FILES: &str = include_str!("../../manual/files.md");

/// The name and the command of every line of the table.
fn lines() -> Vec<(&'static str, &'static str)> {
    let table = FILES.split_once("| your app or logger |").unwrap().1;
    let rows = table
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'));
    rows.map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        (cells[0], cells[2].trim_matches('`'))
    })
    .collect()
}

#[test]
fn every_command_of_the_table_calibrates_both_sensors() {
    let all = layouts(&Samples::of_session());
    assert!(lines().len() > 20);
    let mut failures = Vec::new();
    for (name, command) in lines() {
        let layout = all.iter().find(|layout| layout.name == name);
        let layout = layout.unwrap_or_else(|| panic!("no layout of `{name}`"));
        let folder = tempfile::tempdir().unwrap();
        for (file, content) in &layout.files {
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, content).unwrap();
        }
        let words: Vec<&str> = command
            .strip_prefix("stillpoint ")
            .unwrap()
            .split(' ')
            .collect();
        let run = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
            .args(&words)
            .arg("--json")
            .current_dir(folder.path())
            .output()
            .unwrap();
        let document: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap_or_default();
        let both = document["accelerometer"].is_object() && document["gyroscope"].is_object();
        if !run.status.success() || !both {
            let words = String::from_utf8_lossy(&run.stderr).into_owned();
            failures.push(format!(
                "{name}: {command}: {:?}: {words}",
                run.status.code()
            ));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}
