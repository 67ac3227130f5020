//! The tuning constants of a crate, as its source states them.

use std::io;
use std::path::Path;

use crate::rust_files::rust_files;

/// Folders of the crates whose tuning constants stand in tables.
const CRATES: [&str; 7] = [
    "calib/batch",
    "calib/discover",
    "calib/estimate",
    "calib/live",
    "calib/noise",
    "calib/plan",
    "calib/recording",
];

/// One constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    /// The path by which the study names it: `stillpoint_estimate::gravity::LARGER`.
    pub path: String,
    /// Its file, below the workspace.
    pub file: String,
    /// Its name in the file.
    pub name: String,
    /// Its value, as written.
    pub value: String,
    /// Its meaning.
    pub meaning: String,
}

/// All constants in the tables of the workspace at `root`, by file.
///
/// # Errors
/// A file that cannot be read.
pub fn constants(root: &Path) -> io::Result<Vec<Constant>> {
    let mut all = Vec::new();
    for part in CRATES {
        for file in rust_files(&root.join(part).join("src"))? {
            let shown = file.strip_prefix(root).unwrap_or(&file);
            let shown = shown.to_string_lossy().replace('\\', "/");
            all.extend(in_text(&shown, &std::fs::read_to_string(&file)?));
        }
    }
    Ok(all)
}

/// The constants of one file.
fn in_text(file: &str, text: &str) -> Vec<Constant> {
    let module = module(file);
    let mut all = Vec::new();
    let mut meaning: Vec<&str> = Vec::new();
    let mut is_inside = false;
    for line in text.lines() {
        if !is_inside {
            is_inside = line.ends_with("findings::tuning! {");
            continue;
        }
        let line = line.trim();
        if line == "}" {
            is_inside = false;
        } else if let Some(words) = line.strip_prefix("///") {
            meaning.push(words.trim());
        } else if let Some((name, rest)) = line.split_once(": ") {
            let name = name.rsplit(' ').next().unwrap_or(name);
            let value = rest.split_once(" = ").map_or(rest, |(_, value)| value);
            all.push(Constant {
                path: format!("{module}::{name}"),
                file: file.to_owned(),
                name: name.to_owned(),
                value: value.trim_end_matches(';').to_owned(),
                meaning: std::mem::take(&mut meaning).join(" "),
            });
        }
    }
    all
}

/// The path of a file's module: `calib/estimate/src/gravity.rs` is `stillpoint_estimate::gravity`.
fn module(file: &str) -> String {
    let parts = file.trim_end_matches(".rs").split('/');
    let named = parts.filter(|part| !["calib", "src", "mod", "lib"].contains(part));
    format!("stillpoint_{}", named.collect::<Vec<_>>().join("::"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_gives_names_values_and_meanings() {
        let text = "findings::tuning! {\n    /// Late by so many\n    /// errors.\n    pub(crate) LATE: f64 = 3.0;\n\n    /// Few.\n    FEW: usize = 2;\n}\nlet x: f64 = 1.0;\n";
        let all = in_text("calib/estimate/src/checks/mod.rs", text);
        let found: Vec<_> = all
            .iter()
            .map(|c| (c.path.as_str(), c.value.as_str(), c.meaning.as_str()))
            .collect();
        assert_eq!(
            found,
            [
                (
                    "stillpoint_estimate::checks::LATE",
                    "3.0",
                    "Late by so many errors."
                ),
                ("stillpoint_estimate::checks::FEW", "2", "Few."),
            ]
        );
    }
}
