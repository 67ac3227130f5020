//! The words of messages where there is no command line: names of options and functions instead of flags and commands.

use findings::{Findings, Front};

/// What a message calls an option of the command, and what it is called here.
///
/// An entry for every flag that a message of the libraries names; a test reads their sources.
const OPTIONS: [(&str, &str); 35] = [
    ("--accel-file", "`Recording::from_pair`"),
    ("--accel-unit", "`ReadOptions::accel_unit`"),
    ("--altitude", "`Request::altitude`"),
    ("--columns", "`ReadOptions::columns`"),
    ("--effects", "`Request::effects`"),
    ("--entry", "`ReadOptions::entry`"),
    ("--field", "`Request::field`"),
    ("--flip", "`ReadOptions::flip`"),
    ("--force-device", "`Request::force_device`"),
    ("--format", "`ReadOptions::format`"),
    ("--frame", "`Request::frame`"),
    ("--gravity", "`Request::gravity`"),
    ("--gyro-file", "`Recording::from_pair`"),
    ("--gyro-unit", "`ReadOptions::gyro_unit`"),
    ("--instance", "`ReadOptions::device`"),
    ("--latitude", "`Request::latitude`"),
    ("--mag-unit", "`ReadOptions::mag_unit`"),
    ("--max-bytes", "`ReadOptions::max_bytes`"),
    ("--max-rows", "`ReadOptions::max_rows`"),
    ("--method", "`Request::method`"),
    ("--min-static", "`DetectorOptions::min_static`"),
    ("--motion", "`motion`"),
    ("--multiplier", "`DetectorOptions::multiplier`"),
    ("--na", "`ReadOptions::na_drop`"),
    ("--noise", "`Request::walks`"),
    ("--part", "`ReadOptions::part`"),
    ("--rate", "`ReadOptions::rate`"),
    ("--rest", "`rest`"),
    ("--sensor", "a recording with only the"),
    ("--skip-bad-rows", "`ReadOptions::skip_bad_rows`"),
    ("--sort-time", "`ReadOptions::sort_time`"),
    ("--time-format", "`ReadOptions::time_format`"),
    ("--time-unit", "`ReadOptions::time_unit`"),
    ("--topic", "`ReadOptions::topics`"),
    ("--window", "`DetectorOptions::window`"),
];

/// Commands that messages name, and the functions here.
const COMMANDS: [(&str, &str); 5] = [
    ("`stillpoint discover`", "`discover`"),
    ("`stillpoint bias`", "a longer recording"),
    ("(`stillpoint effects`)", "(`Catalogue::names`)"),
    ("`calibrate --method stepwise`", "`Method::Stepwise`"),
    ("stillpoint segment", "`evaluate`"),
];

/// Findings in the words of this library.
pub(crate) fn all_of_the_library(findings: &Findings) -> Vec<String> {
    let texts = findings.texts(Front::Rust).into_iter();
    texts.map(|text| of_the_library(&text)).collect()
}

/// The message in the words of this library.
pub(crate) fn of_the_library(message: &str) -> String {
    let mut text = message.to_owned();
    for (command, function) in COMMANDS {
        text = text.replace(command, function);
    }
    let mut said = String::with_capacity(text.len());
    let mut rest = text.as_str();
    while let Some(at) = rest.find("--") {
        let (before, flag) = rest.split_at(at);
        let is_letter = |c: char| c.is_ascii_lowercase() || c == '-';
        let end = flag.find(|c| !is_letter(c)).unwrap_or(flag.len());
        let (flag, after) = flag.split_at(end);
        said.push_str(before);
        let known = OPTIONS.iter().find(|(option, _)| *option == flag);
        said.push_str(known.map_or(flag, |(_, name)| name));
        rest = after;
    }
    said + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_become_options() {
        let said =
            of_the_library("at rest; say the unit, as in --accel-unit m/s^2 (--force-device)");
        assert_eq!(
            said,
            "at rest; say the unit, as in `ReadOptions::accel_unit` m/s^2 (`Request::force_device`)"
        );
        assert_eq!(of_the_library("a -- b"), "a -- b");
    }

    /// Of the libraries' sources, without comments and what stands in tests.
    #[test]
    fn every_flag_that_a_library_names_has_a_name_here() {
        let mut flags = std::collections::BTreeSet::new();
        for folder in [
            "../src",
            "../recording/src",
            "../effects/src",
            "../simulate/src",
            "../noise/src",
            "../estimate/src",
            "../discover/src",
            "../formats/src",
            "../../models",
            "../../solver/src",
        ] {
            let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
            for source in sources(&folder) {
                let text = std::fs::read_to_string(source).unwrap();
                let own = text.split("#[cfg(test)]").next().unwrap_or_default();
                let code = own
                    .lines()
                    .filter(|line| !line.trim_start().starts_with("//"));
                for line in code {
                    flags.extend(named_in(line));
                }
            }
        }
        // Of another program, and of cargo.
        let others = [
            "---",
            "--csv",
            "--features",
            "--release",
            "--ignored",
            "--prior",
            "--unit-acceleration",
            "--unit-rotation",
        ];
        let unknown: Vec<_> = flags
            .iter()
            .filter(|flag| !others.contains(&flag.as_str()))
            .filter(|flag| OPTIONS.iter().all(|(option, _)| option != flag))
            .collect();
        assert!(unknown.is_empty(), "{unknown:?}");
        assert!(flags.len() > 20, "{flags:?}");
    }

    fn named_in(line: &str) -> Vec<String> {
        let of = |(at, _): (usize, &str)| {
            let name = line[at + 2..].split(|c: char| !c.is_ascii_lowercase() && c != '-');
            let name = name.into_iter().next().filter(|name| !name.is_empty())?;
            Some(format!("--{name}"))
        };
        line.match_indices("--").filter_map(of).collect()
    }

    fn sources(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
        let mut found = Vec::new();
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            match path.extension() {
                _ if path.is_dir() => found.extend(sources(&path)),
                Some(ending) if ending == "rs" && !path.ends_with("tests.rs") => found.push(path),
                _ => {}
            }
        }
        found
    }
}
