//! The page of the tuning constants: meaning, value, and how much depends on each.

use std::collections::HashMap;
use std::fmt::Write;

use super::{Constant, Moved, sessions};

/// Where the page begins: what its columns are.
const HEAD: &str = "# Tuning constants

Numbers that decide: levels of tests, fewest and most, limits of a search. A law of physics or the size of a matrix is none. Each stands
in a table of the file that uses it (`findings::tuning!`); this page is written from those tables by a study
(`cargo run --release -p stillpoint-tests --features vary --bin tuning-study -- --page cli/manual/tuning.md`).

The study takes each constant at half and at twice its value through the same sessions, a calibration or a search each. `3 + 2` says that
3 of them have other findings and 2 more have a number that moved by more than a tenth of its standard error; `·` says that nothing
moved, and a blank that no session comes to the constant, as few of them have any one fault, or that it has not been measured yet; `fails`
that a run with it has no end.
";

/// A constant with what was measured of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The file and the name.
    pub place: (String, String),
    /// The value.
    pub value: String,
    /// At half and at twice the value, as printed.
    pub moved: [String; 2],
}

/// The page.
/// `moved` is what was measured, by the path of the constant.
pub fn page(constants: &[Constant], moved: &HashMap<String, [String; 2]>) -> String {
    let measured: Vec<_> = constants.iter().map(|own| moved.get(&own.path)).collect();
    let mut page = HEAD.to_owned();
    let reached = measured.iter().flatten();
    let still = reached
        .clone()
        .filter(|both| both.iter().all(|moved| moved == STILL));
    let _ = writeln!(
        page,
        "\nOf {} constants {} have been measured in {} sessions; of these {} move nothing at half or at twice their value.",
        constants.len(),
        reached.count(),
        sessions(),
        still.count()
    );
    let mut file = "";
    for (constant, moved) in constants.iter().zip(measured) {
        if constant.file != file {
            file = &constant.file;
            let _ = writeln!(
                page,
                "\n## `{file}`\n\n| constant | value | × ½ | × 2 | meaning |\n| --- | --- | --- | --- | --- |"
            );
        }
        let [half, twice] = moved.cloned().unwrap_or_default();
        // The links of its doc lead nowhere from a page.
        let meaning = constant.meaning.replace("[`", "`").replace("`]", "`");
        let meaning = meaning.replace('|', "\\|");
        let _ = writeln!(
            page,
            "| `{}` | `{}` | {half} | {twice} | {meaning} |",
            constant.name, constant.value
        );
    }
    page
}

/// What a page says of these constants, by their paths.
pub fn measured_on(old: &str, constants: &[Constant]) -> HashMap<String, [String; 2]> {
    let rows = rows_of(old).into_iter();
    let measured = rows.filter(|row| !row.moved[0].is_empty());
    let mut of_place: HashMap<_, _> = measured.map(|row| (row.place, row.moved)).collect();
    let known = constants.iter().filter_map(|constant| {
        let place = (constant.file.clone(), constant.name.clone());
        Some((constant.path.clone(), of_place.remove(&place)?))
    });
    known.collect()
}

/// The page with the constants as they are now, and what was measured of them.
pub fn written_again(constants: &[Constant], old: &str) -> String {
    page(constants, &measured_on(old, constants))
}

/// In place of a count where nothing moved.
const STILL: &str = "·";

/// `3 + 2`: sessions with other findings, and with other numbers.
pub fn words(moved: Moved) -> String {
    match (moved.said, moved.numbers) {
        (0, 0) => STILL.into(),
        (said, numbers) => format!("{said} + {numbers}"),
    }
}

/// The rows of a page.
pub fn rows_of(page: &str) -> Vec<Row> {
    let mut file = String::new();
    let mut rows = Vec::new();
    for line in page.lines() {
        if let Some(named) = line.strip_prefix("## `") {
            file = named.trim_end_matches('`').to_owned();
        }
        let cells: Vec<&str> = line.splitn(7, '|').map(str::trim).collect();
        let ["", name, value, half, twice, ..] = cells.as_slice() else {
            continue;
        };
        if name.starts_with('`') {
            rows.push(Row {
                place: (file.clone(), name.trim_matches('`').to_owned()),
                value: value.trim_matches('`').to_owned(),
                moved: [(*half).to_owned(), (*twice).to_owned()],
            });
        }
    }
    rows
}
