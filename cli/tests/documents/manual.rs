//! Every command of the manual, run: its output is what the manual shows.
//!
//! `TRYCMD=overwrite cargo test -p stillpoint --test manual` writes today's output into the manual.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};

use stillpoint_tests::needed_data::needed;

fn manual() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("manual")
}

/// Runs `chapter` beside links to `recordings`, each a name and a path.
fn run(chapter: &str, recordings: &[(String, PathBuf)]) {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join(chapter);
    std::fs::copy(manual().join(chapter), &copy).unwrap();
    // Where the commands of `NAME.md` run.
    let inputs = copy.with_extension("in");
    std::fs::create_dir(&inputs).unwrap();
    for (name, path) in recordings {
        std::os::unix::fs::symlink(path.canonicalize().unwrap(), inputs.join(name)).unwrap();
    }
    let cases = trycmd::TestCases::new();
    cases.case(&copy);
    // Runs on drop, and panics where an output differs.
    drop(cases);
    if std::env::var_os("TRYCMD").is_some_and(|action| action == "overwrite") {
        std::fs::copy(&copy, manual().join(chapter)).unwrap();
    }
}

#[test]
fn the_phone_experiment_gives_what_the_manual_shows() {
    let Some(phone) = needed("phone") else { return };
    let mut recordings = Vec::new();
    for part in ["multi_position", "six_position", "cart"] {
        for entry in std::fs::read_dir(phone.join(part)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_dir() {
                recordings.push((name, path));
            }
        }
    }
    recordings.push(("walking".to_owned(), phone.join("walking")));
    run("experiment.md", &recordings);
}

#[test]
fn the_reference_of_specifications_is_the_one_that_the_program_prints() {
    run("simulation.md", &[]);
}

#[test]
fn the_options_without_effect_are_those_that_the_program_knows() {
    run("options.md", &[]);
}
