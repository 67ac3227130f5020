//! The house is kept: rooms that can be overlooked, files without circles, and a README that is read in one go.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod circles;
mod sentences;
mod tuning;

use std::path::{Path, PathBuf};

/// Files beside each other in a folder.
const MOST_FILES: usize = 15;

/// Lines of the README.
const MOST_LINES: usize = 120;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The folders of code below `folder`, each with the number of its Rust files.
fn rooms(folder: &Path, all: &mut Vec<(PathBuf, usize)>) {
    let mut files = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() && !["target", "corpus"].contains(&name.as_str()) {
            rooms(&path, all);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files += 1;
        }
    }
    all.push((folder.to_owned(), files));
}

#[test]
fn no_folder_but_those_of_effects_holds_more_than_fifteen_files() {
    let mut all = Vec::new();
    for part in ["solver", "models", "calib", "cli", "tests", "benches"] {
        rooms(&root().join(part), &mut all);
    }
    assert!(all.len() > 100, "{} folders", all.len());
    let is_of_effects = |path: &Path| path.ends_with("src/effects");
    all.retain(|(path, files)| *files > MOST_FILES && !is_of_effects(path));
    assert!(all.is_empty(), "{all:#?}");
}

#[test]
fn the_readme_has_at_most_a_hundred_and_twenty_lines() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let lines = readme.lines().count();
    assert!(lines <= MOST_LINES, "{lines} lines");
}

/// The root files of the crates below `folder`.
fn crates(folder: &Path, all: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let is_apart = ["target", "peers", "fuzz"]
            .iter()
            .any(|name| path.ends_with(name));
        if path.is_dir() && !is_apart {
            crates(&path, all);
        }
    }
    if folder.ends_with("src") {
        let roots = ["lib.rs", "main.rs"].map(|name| folder.join(name));
        all.extend(roots.into_iter().filter(|root| root.exists()));
    }
}

#[test]
fn no_files_of_a_crate_name_each_other_in_a_circle() {
    let mut roots = Vec::new();
    crates(root(), &mut roots);
    assert!(roots.len() > 20, "{roots:#?}");
    let found: Vec<Vec<PathBuf>> = roots
        .iter()
        .flat_map(|root| circles::circles(root))
        .collect();
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn no_library_but_the_tables_of_findings_holds_a_sentence_a_flag_or_a_command() {
    let mut folders: Vec<PathBuf> = Vec::new();
    for part in ["calib", "models"] {
        let mut roots = Vec::new();
        crates(&root().join(part), &mut roots);
        folders.extend(roots.iter().map(|root| root.parent().unwrap().to_owned()));
    }
    folders.retain(|folder| !folder.ends_with("findings/src"));
    folders.sort();
    folders.dedup();
    assert!(folders.len() > 15, "{folders:#?}");
    let found = sentences::sentences(&folders);
    assert!(found.is_empty(), "{} sentences: {found:#?}", found.len());
}
