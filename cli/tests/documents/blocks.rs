//! The blocks of code in the book and in the project's README, and running them as a reader would.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A block of code between two fences.
pub struct Block {
    /// The words behind the opening fence.
    pub words: Vec<String>,
    /// What it holds.
    pub text: String,
}

impl Block {
    /// The words behind the opening fence, as they are compared.
    pub fn kind(&self) -> Vec<&str> {
        self.words.iter().map(String::as_str).collect()
    }
}

/// Every block of a text, in order.
pub fn blocks(markdown: &str) -> Vec<Block> {
    let mut all: Vec<Block> = Vec::new();
    let mut is_open = false;
    for line in markdown.lines() {
        match (line.strip_prefix("```"), is_open) {
            (Some(words), false) => {
                let words = words.split_whitespace().map(str::to_owned).collect();
                let text = String::new();
                all.push(Block { words, text });
                is_open = true;
            }
            (Some(_), true) => is_open = false,
            (None, true) => {
                let block = all.last_mut().unwrap();
                block.text.push_str(line);
                block.text.push('\n');
            }
            (None, false) => {}
        }
    }
    assert!(!is_open, "a block that nothing closes");
    all
}

/// The folder of the book.
pub fn manual() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("manual")
}

/// The project's README and every page of the book, each with its name and text.
pub fn pages() -> Vec<(String, String)> {
    let readme = manual().join("../../README.md");
    let mut all = vec![(
        "the project's README".to_owned(),
        std::fs::read_to_string(readme).unwrap(),
    )];
    let entries = std::fs::read_dir(manual()).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.retain(|path| path.extension().is_some_and(|e| e == "md"));
    for path in paths {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        all.push((name, std::fs::read_to_string(&path).unwrap()));
    }
    all
}

/// Runs lines of a shell in a folder, the program of this build first on its path.
fn shell(folder: &Path, lines: &str) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_stillpoint"));
    let own = program.parent().unwrap().to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let paths = std::iter::once(own).chain(std::env::split_paths(&path));
    Command::new("bash")
        .args(["-euo", "pipefail", "-c", lines])
        .env("PATH", std::env::join_paths(paths).unwrap())
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Writes the files that a page shows and runs its blocks of commands, in the order of the page. Gives what they printed.
pub fn run(page: &str, folder: &Path) -> String {
    let (_, text) = pages().into_iter().find(|(name, _)| name == page).unwrap();
    let mut said = String::new();
    let mut calls = 0;
    for block in blocks(&text) {
        match block.kind().as_slice() {
            ["toml" | "python", file] => {
                std::fs::write(folder.join(file), &block.text).unwrap();
            }
            ["sh"] => {
                let run = shell(folder, &block.text);
                let words = String::from_utf8_lossy(&run.stderr);
                assert!(run.status.success(), "{page}: {}\n{words}", block.text);
                said.push_str(&String::from_utf8_lossy(&run.stdout));
                calls += 1;
            }
            _ => {}
        }
    }
    assert!(calls > 0, "{page} has no command");
    said
}

/// Whether a page says something, in these words, wherever its lines break.
pub fn is_said(page: &str, words: &str) -> bool {
    let (_, text) = pages().into_iter().find(|(name, _)| name == page).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    text.contains(words)
}
