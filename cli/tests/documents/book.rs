//! The manual as a book: every chapter is in its contents, every link and picture is there, and it can be built.

use super::blocks;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use blocks::{manual, pages};
use stillpoint_tests::needed_data::skipped;

/// Bytes of a picture.
const LARGEST_PICTURE: u64 = 25_000;

/// Bytes of the chapter on the phone experiment.
const LONGEST_STORY: usize = 12_000;

/// Lines of the changelog.
const LONGEST_CHANGELOG: usize = 150;

/// Where the links of a text lead, those of pictures included; blocks of code have none.
fn links(markdown: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut is_code = false;
    for line in markdown.lines() {
        is_code ^= line.starts_with("```");
        if is_code {
            continue;
        }
        for after in line.split("](").skip(1) {
            all.push(after.split_once(')').unwrap().0.to_owned());
        }
        for after in line.split("src=\"").skip(1) {
            all.push(after.split_once('"').unwrap().0.to_owned());
        }
    }
    all
}

/// The anchors of a text's headings, as a forge and mdBook make them.
fn anchors(markdown: &str) -> Vec<String> {
    let mut is_code = false;
    let heading = |line: &str| {
        is_code ^= line.starts_with("```");
        let words = line.strip_prefix('#').filter(|_| !is_code)?;
        let words = words.trim_start_matches('#').trim().to_lowercase();
        let kept = words
            .chars()
            .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        Some(kept.collect::<String>().replace(' ', "-"))
    };
    markdown.lines().filter_map(heading).collect()
}

#[test]
fn every_chapter_is_in_the_contents_and_in_the_documentation_of_the_code() {
    let contents = std::fs::read_to_string(manual().join("SUMMARY.md")).unwrap();
    let listed: BTreeSet<String> = links(&contents).into_iter().collect();
    let code = include_str!("../../src/manual.rs");
    let mut chapters = BTreeSet::new();
    for (page, text) in pages().into_iter().skip(1) {
        if page == "SUMMARY.md" {
            continue;
        }
        assert!(text.starts_with("# "), "{page} has no title");
        if page != "README.md" {
            let included = format!("include_str!(\"../manual/{page}\")");
            assert!(code.contains(&included), "{page} is not in manual.rs");
        }
        chapters.insert(page);
    }
    assert_eq!(listed, chapters);
}

#[test]
fn every_link_leads_somewhere_and_none_out_of_the_book() {
    let mut count = 0;
    for (page, text) in pages() {
        let is_book = page != "the project's README";
        let folder = if is_book {
            manual()
        } else {
            manual().join("../..")
        };
        for link in links(&text) {
            count += 1;
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            assert!(
                !file.starts_with("http"),
                "{page}: {link}: a reader may be offline"
            );
            assert!(
                !is_book || !file.contains(".."),
                "{page}: {link}: not in the book"
            );
            let path = match file {
                "" => folder.join(&page),
                file => folder.join(file),
            };
            assert!(path.exists(), "{page}: {link}: not there");
            if !anchor.is_empty() {
                let there = anchors(&std::fs::read_to_string(&path).unwrap());
                assert!(
                    there.iter().any(|a| a == anchor),
                    "{page}: {link}: {there:?}"
                );
            }
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn files_that_the_book_names_are_there() {
    let root = manual().join("../..");
    for (page, text) in pages() {
        for code in text.split('`').skip(1).step_by(2) {
            let first = code.split('/').next().unwrap();
            let is_ours = ["solver", "models", "calib", "cli", "tests", "benches"].contains(&first);
            // `tests/fuzz/run TARGET` is a call of a file.
            let path = code.split(' ').next().unwrap();
            let is_pattern = path.contains(['*', '$', '\n']);
            // Built, and not in the repository.
            let is_pattern = is_pattern || path == "cli/web/stillpoint.html";
            if is_ours && code.contains('/') && !is_pattern {
                assert!(root.join(path).exists(), "{page}: `{path}` is not there");
            }
        }
    }
}

#[test]
fn every_picture_is_small_shown_and_has_words_for_those_who_do_not_see_it() {
    let all: String = pages().into_iter().map(|(_, text)| text).collect();
    for entry in std::fs::read_dir(manual().join("pictures")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let size = std::fs::metadata(&path).unwrap().len();
        assert!(size <= LARGEST_PICTURE, "{name}: {size} bytes");
        assert!(
            all.contains(&format!("pictures/{name}")),
            "{name} is shown nowhere"
        );
    }
    assert!(!all.contains("![]("));
}

#[test]
fn no_chapter_is_pasted_output() {
    let story = std::fs::read_to_string(manual().join("experiment.md")).unwrap();
    assert!(story.len() <= LONGEST_STORY, "{} bytes", story.len());
    let changelog = std::fs::read_to_string(manual().join("../../CHANGELOG.md")).unwrap();
    let lines = changelog.lines().count();
    assert!(lines <= LONGEST_CHANGELOG, "{lines} lines");
    for group in ["### Added", "### Changed", "### Fixed"] {
        assert!(changelog.contains(group), "{group}");
    }
}

/// Where mdBook is there; `.ci/book` brings it.
#[test]
fn the_book_is_built_without_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let mut build = Command::new("mdbook");
    let build = build.arg("build").arg(manual());
    let Ok(run) = build.arg("--dest-dir").arg(folder.path()).output() else {
        skipped("no mdbook; .ci/book installs it");
        return;
    };
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success() && !said.contains("WARN"), "{said}");
    for page in ["index.html", "first_calibration.html", "solver.html"] {
        assert!(folder.path().join(page).exists(), "{page}");
    }
    assert!(Path::new(&folder.path().join("pictures/gap.svg")).exists());
}
