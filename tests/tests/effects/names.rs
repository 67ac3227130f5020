//! An effect says everything about itself: no other code knows it by name.

use std::path::{Path, PathBuf};

/// Files outside `models/` with a word that happens to be the name of an effect: path, word and what it is there.
const OTHER_MEANINGS: [(&str, &str, &str); 1] = [(
    "calib/exchange/src/targets/kalibr.rs",
    "time_offset",
    "a key of the format of Kalibr",
)];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn sources(folder: &Path, all: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).unwrap();
    for path in entries.map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() && !["tests", "target"].contains(&name) {
            sources(&path, all);
        } else if path.extension().is_some_and(|e| e == "rs") && name != "tests.rs" {
            all.push(path);
        }
    }
}

/// Every `src` of a crate below `folder`.
fn rooms(folder: &Path, all: &mut Vec<PathBuf>) {
    if folder.join("Cargo.toml").exists() && folder.join("src").exists() {
        all.push(folder.join("src"));
    }
    let entries = std::fs::read_dir(folder).unwrap();
    let folders = entries.map(|entry| entry.unwrap().path()).filter(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        path.is_dir() && !["src", "tests", "target"].contains(&name)
    });
    folders.for_each(|folder| rooms(&folder, all));
}

/// What stands in `text` before `from` and after the next `to`, for every `from`.
fn without(text: &str, from: &str, to: &str) -> String {
    let mut parts = text.split(from);
    let mut rest = parts.next().unwrap().to_owned();
    for part in parts {
        rest.push_str(part.split_once(to).map_or("", |(_, after)| after));
    }
    rest
}

/// The code of a file: without comments, tests, what is compiled for tests alone and the examples in the help.
fn code(text: &str) -> String {
    let (code, _tests) = text.split_once("#[cfg(test)]\nmod").unwrap_or((text, ""));
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    without(&code, "after_help = \"", "\")]")
}

/// `gyro_g_sensitivity` as a type is called: `GyroGSensitivity`.
fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, others) = word.split_at(1);
        first.to_uppercase() + others
    });
    words.collect()
}

/// The effects whose name stands in `code` as a word of its own: in a text, as an identifier or as a type.
fn named(code: &str) -> Vec<String> {
    let words: std::collections::HashSet<&str> = code
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .collect();
    calib::effects::catalogue()
        .map(|effect| effect.name().to_owned())
        .filter(|name| words.contains(name.as_str()) || words.contains(camel(name).as_str()))
        .collect()
}

#[test]
fn effects_are_named_in_their_crates_only() {
    let mut all = Vec::new();
    let mut rooms_of_all = Vec::new();
    for crates in ["solver", "calib", "cli"] {
        rooms(&root().join(crates), &mut rooms_of_all);
    }
    for room in &rooms_of_all {
        sources(room, &mut all);
    }
    assert!(rooms_of_all.len() >= 15, "{rooms_of_all:?}");
    assert!(all.len() > 500, "{} files", all.len());
    let mut found = Vec::new();
    for path in &all {
        let own = path.strip_prefix(root()).unwrap().to_str().unwrap();
        // An oracle is compiled in tests alone.
        if own.ends_with("/oracle.rs") {
            continue;
        }
        for name in named(&code(&std::fs::read_to_string(path).unwrap())) {
            if !OTHER_MEANINGS
                .iter()
                .any(|(file, word, _)| *file == own && *word == name)
            {
                found.push((own, name));
            }
        }
    }
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn a_name_in_code_is_found_and_one_in_a_test_or_the_help_is_not() {
    let text = "let a = \"gyro_delay\";\n// \"gyro_step\"\n#[command(after_help = \"--effects gyro_cubic\")]\n\
                use x::accel_drift;\n#[cfg(test)]\nmod tests { \"gyro_drift\" }";
    assert_eq!(named(&code(text)), ["accel_drift", "gyro_delay"]);
}

#[test]
fn a_type_is_found_and_a_longer_word_is_not() {
    assert_eq!(
        named("gyroscope::GyroG2Sensitivity"),
        ["gyro_g2_sensitivity"]
    );
    assert_eq!(named("my_gyro_delay, gyro_delays"), [""; 0]);
}
