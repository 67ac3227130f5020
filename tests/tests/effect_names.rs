//! An effect says everything about itself: no other code knows it by name.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};

fn sources(folder: &Path, all: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).unwrap();
    for path in entries.map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() && !["tests", "examples", "benches", "target"].contains(&name) {
            sources(&path, all);
        } else if path.extension().is_some_and(|e| e == "rs") && name != "tests.rs" {
            all.push(path);
        }
    }
}

/// The code of a file without comments and tests.
fn code(text: &str) -> String {
    let (code, _tests) = text.split_once("#[cfg(test)]\nmod").unwrap_or((text, ""));
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// The names in `code` as a text or as the beginning of a parameter's name.
fn named(code: &str) -> Vec<&'static str> {
    let names = calib::effects::catalogue().map(|effect| effect.name());
    let is_there =
        |name: &&str| code.contains(&format!("\"{name}\"")) || code.contains(&format!("\"{name}."));
    names.filter(is_there).collect()
}

#[test]
fn effects_are_named_in_their_crates_only() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut all = Vec::new();
    for crates in ["solver", "calib", "cli"] {
        sources(&root.join(crates), &mut all);
    }
    assert!(all.len() > 500, "{} files", all.len());
    // An oracle is compiled in tests alone.
    let found: Vec<_> = all
        .iter()
        .filter(|path| !path.ends_with("oracle.rs"))
        .map(|path| (path, named(&code(&std::fs::read_to_string(path).unwrap()))))
        .filter(|(_, names)| !names.is_empty())
        .collect();
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn a_name_in_code_is_found_and_one_in_a_test_is_not() {
    let text =
        "let a = \"gyro_delay\";\n// \"gyro_step\"\n#[cfg(test)]\nmod tests { \"gyro_drift\" }";
    assert_eq!(named(&code(text)), ["gyro_delay"]);
}
