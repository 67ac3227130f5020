//! Tables and numbers for people.

use std::io::Write;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use ::findings::{Finding, Front, Step};
use calib::document::to_json;
use comfy_table::presets::NOTHING;
use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Row, Table, Width,
};

use serde::Serialize;

use crate::exit::{BUG, Failure, OUTPUT};
pub use crate::quoted::{name, path, printable, shortened};
use crate::terminal;

/// A path as a shell takes it.
pub fn command_line(name: &Path) -> String {
    let text = path(name);
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '/' | '.' | '_' | '-' | '+');
    match text.chars().all(plain) && !text.starts_with('-') || text == "-" {
        true => text,
        false => format!("'{}'", text.replace('\'', "'\\''")),
    }
}

/// A table whose columns after the first are aligned right.
pub fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING.header_separator(LineStyle::new('─', '─', '─', '─')));
    table.set_content_arrangement(ContentArrangement::Dynamic);
    // A space on either side of the outer columns is cut off again.
    table.set_width(u16::try_from(terminal::width()).unwrap_or(u16::MAX));
    table.set_header(header.to_vec());
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// A table of words, whose columns are all aligned left.
pub fn texts(header: &[&str]) -> Table {
    let mut table = table(header);
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Left);
    }
    table
}

/// A table with rows.
pub fn table_of<R: Into<Row>>(header: &[&str], rows: impl IntoIterator<Item = R>) -> Table {
    let mut table = table(header);
    table.add_rows(rows);
    table
}

/// The longest name that the first column is as wide as: a longer one leaves the others too little.
const WHOLE: usize = 30;

/// Breaks no word of the first column, whose names people search for.
pub fn keep_names_whole<'a>(table: &mut Table, names: impl Iterator<Item = &'a str>) {
    let words = names.flat_map(str::split_whitespace);
    let longest = words.map(|word| word.chars().count()).max().unwrap_or(0);
    let margin = 2;
    if let (Some(first), true) = (table.column_mut(0), longest <= WHOLE) {
        let width = u16::try_from(longest + margin).unwrap_or(u16::MAX);
        first.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(width)));
    }
}

/// Flag that is set before anything is written to standard output.
static PRINTED: AtomicBool = AtomicBool::new(false);

/// Prints a result. A reader that has closed the pipe (`| head`) is no error.
///
/// # Errors
/// Status 6 where standard output cannot be written, such as a file on a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    PRINTED.store(true, Ordering::SeqCst);
    let mut out = std::io::stdout().lock();
    printed(writeln!(out, "{}", printable(text.trim_end())))
}

/// Result of printing something on standard output, the last line of which may be on its way still.
///
/// # Errors
/// As [`print`].
pub fn printed(written: std::io::Result<()>) -> Result<(), Failure> {
    match written.and_then(|()| std::io::stdout().flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::new(
            OUTPUT,
            format!("standard output cannot be written: {e}"),
        )),
        _ => Ok(()),
    }
}

/// A document for `-o` and `--json`, as [`to_json`] writes it.
///
/// # Errors
/// Status 7: the document holds what JSON cannot.
pub fn json(document: &impl Serialize) -> Result<String, Failure> {
    to_json(document).map_err(|e| Failure::new(BUG, e.to_string()))
}

/// A note or a warning.
pub fn warn(text: &str) {
    if !terminal::is_quiet() {
        let label = terminal::coloured("warning:", 33);
        say_after(&label, &format!("warning: {}", shortened(text)));
    }
}

/// Findings as warnings.
pub fn warn_each<'a>(findings: impl IntoIterator<Item = &'a Finding>) {
    let findings = findings.into_iter();
    findings.for_each(|found| warn(&found.text(Front::CommandLine)));
}

/// Prints a note on standard error, unless the output is quiet.
pub fn note(text: &str) {
    if !terminal::is_quiet() {
        say(text);
    }
}

/// A message whose first word is `label`, perhaps coloured.
fn say_after(label: &str, text: &str) {
    let text = printable(text);
    let text = match terminal::error_width() {
        Some(width) => terminal::wrapped(&text, width),
        None => text.into_owned(),
    };
    let rest = text.split_once(':').map_or(text.as_str(), |(_, rest)| rest);
    let _ = writeln!(std::io::stderr(), "{label}{rest}");
}

/// The text with a capital letter.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// A step as a sentence, its command behind it.
pub fn step(step: &Step) -> String {
    let text = capital(&step.text);
    match &step.command {
        Some(command) => format!("{text}: {command}"),
        None => format!("{}.", text.trim_end_matches('.')),
    }
}

/// `1 minute`, `2 minutes`.
pub fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

/// A text for people in lines that fit on standard output.
pub fn wrapped(text: &str) -> String {
    terminal::wrapped(text, terminal::width())
}

/// Warnings, those alike in one line with their number.
pub fn warn_all(texts: &[String]) {
    if terminal::is_verbose() {
        return texts.iter().for_each(|text| warn(text));
    }
    folded(texts).iter().for_each(|text| warn(text));
}

/// The first line of a warning or one that goes on below it, as the first screen has them.
pub fn remark(line: &str) {
    match line.strip_prefix("warning:") {
        Some(rest) => {
            let label = terminal::coloured("warning:", 33);
            let _ = writeln!(std::io::stderr(), "{label}{}", printable(rest));
        }
        None => say(line),
    }
}

/// The first sentence of a message, without its odds and without its advice: these are said with `-v`.
pub fn gist(message: &str) -> String {
    let end = message.find(". ").unwrap_or(message.len());
    let sentence = message[..end].trim_end_matches('.');
    without_odds(before_semicolon(sentence))
}

/// Returns the text before the first semicolon outside brackets.
fn before_semicolon(sentence: &str) -> &str {
    let mut depth = 0;
    for (at, c) in sentence.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ';' if depth <= 0 => return &sentence[..at],
            _ => {}
        }
    }
    sentence
}

/// The text without the brackets that hold odds.
pub fn without_odds(text: &str) -> String {
    let (mut gist, mut remaining) = (String::new(), text);
    while let Some((before, inside, after)) = brackets(remaining) {
        gist.push_str(before);
        let has_odds = ["p = ", "p < ", "by chance", "degrees of freedom"]
            .iter()
            .any(|odds| inside.contains(odds));
        if !has_odds {
            gist.push_str(&format!(" ({inside})"));
        }
        remaining = after;
    }
    gist + remaining
}

/// Returns the text before the first brackets, inside them, and after them.
fn brackets(text: &str) -> Option<(&str, &str, &str)> {
    let (before, more) = text.split_once(" (")?;
    let (inside, after) = more.split_once(')')?;
    Some((before, inside, after))
}

/// Alike warnings that are all said.
const ALIKE: usize = 3;

/// Warnings that differ in their numbers only are alike: of many the first stands for all.
pub fn folded(texts: &[String]) -> Vec<String> {
    let mut kinds: Vec<(String, Vec<&String>)> = Vec::new();
    for text in texts {
        let shape = shape(text);
        match kinds.iter_mut().find(|(other, _)| *other == shape) {
            Some((_, alike)) => alike.push(text),
            None => kinds.push((shape, vec![text])),
        }
    }
    let said = |(_, alike): (String, Vec<&String>)| match alike.as_slice() {
        [first, others @ ..] if others.len() >= ALIKE => {
            vec![format!("{first} (and {} more like this)", others.len())]
        }
        all => all.iter().map(|text| (*text).clone()).collect(),
    };
    kinds.into_iter().flat_map(said).collect()
}

/// A text without its numbers.
fn shape(text: &str) -> String {
    let mut shape = String::new();
    for c in text.chars() {
        if !(c.is_ascii_digit() || (c == '.' && shape.ends_with('#'))) {
            shape.push(c);
        } else if !shape.ends_with('#') {
            shape.push('#');
        }
    }
    shape
}

/// A line on standard error; one that is closed is no error.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", printable(text));
}

/// Says why the program ends, and with `--json` prints it, unless something is printed already.
pub fn failure(failure: &Failure) {
    if failure.message.is_empty() {
        return;
    }
    let label = terminal::coloured("stillpoint:", 31);
    say_after(
        &label,
        &format!("stillpoint: {}", shortened(&failure.message)),
    );
    let asked = std::env::args_os()
        .take_while(|arg| arg != "--")
        .any(|arg| arg == "--json");
    if asked
        && !PRINTED.swap(true, Ordering::SeqCst)
        && let Ok(document) = json(&failure.document())
    {
        let mut out = std::io::stdout().lock();
        let _ = out
            .write_all(document.as_bytes())
            .and_then(|()| out.flush());
    }
}

/// A number with as many decimals as its standard error warrants (two significant figures of it).
pub fn value(value: f64, std: Option<f64>) -> String {
    let decimals = match std {
        Some(s) if s > 0.0 && s.is_finite() => (1.0 - s.log10().floor()).clamp(0.0, 12.0) as usize,
        _ => 6,
    };
    format!("{value:.decimals$}")
}

/// `4300`: a number of which no more than so many figures are other than zero.
pub fn rounded(value: f64, figures: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let unit = 10f64.powf(value.abs().log10().floor() - f64::from(figures - 1));
    self::figures((value / unit).round() * unit, figures)
}

/// A number to so many significant figures, with six decimals at most.
pub fn figures(value: f64, figures: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let beyond_the_first = f64::from(figures - 1);
    let decimals = (beyond_the_first - value.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

/// `24.1 → 2.5 mm/s²`: a size before and after; `raw 24.1 mm/s²` where nothing is known of it after.
pub fn arrow([before, after]: [Option<f64>; 2], unit: &str) -> Option<String> {
    let shown = |value: f64| figures(value, 3);
    match (before, after) {
        (Some(before), Some(after)) => Some(format!("{} → {}{unit}", shown(before), shown(after))),
        (None, Some(one)) => Some(format!("{}{unit}", shown(one))),
        (Some(one), None) => Some(format!("raw {}{unit}", shown(one))),
        (None, None) => None,
    }
}

/// `1400 ± 2200`: a value with its standard error, both to two significant figures of the error; alone where it has none.
pub fn with_error(value: f64, std: Option<f64>) -> String {
    let Some(std) = std.filter(|s| *s > 0.0 && s.is_finite()) else {
        return figures(value, 3);
    };
    // Figures that mean nothing are zeros.
    let unit = 10f64.powf(std.log10().floor() - 1.0);
    let round = |v: f64| (v / unit).round() * unit;
    let decimals = (1.0 - std.log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{:.decimals$} ± {:.decimals$}", round(value), round(std))
}

/// A standard error to two significant figures.
pub fn error(std: Option<f64>) -> String {
    match std {
        None => "fixed".into(),
        Some(s) if s > 0.0 && s.is_finite() => value(s, Some(s)),
        Some(s) => format!("{s}"),
    }
}

/// A smaller chance says nothing about a device: no model is so sure.
const SMALLEST: f64 = 1e-15;

/// A chance: `3e-11`, `0.004`.
pub fn chance(p: f64) -> String {
    if p < SMALLEST {
        "< 1e-15".into()
    } else if p < 1e-3 {
        format!("{p:.0e}")
    } else {
        format!("{p:.3}")
    }
}

/// The same as a probability: `p = 0.004`, `p < 1e-15`.
pub fn probability(p: f64) -> String {
    let chance = chance(p);
    let sign = if chance.starts_with('<') { "" } else { "= " };
    format!("p {sign}{chance}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_in_their_numbers_are_said_once_with_a_count() {
        let texts = [
            "stretch 1.25 to 3.5 s",
            "stretch 7 to 8.25 s",
            "other",
            "stretch 9.1 to 10 s",
            "stretch 11 to 12 s",
        ]
        .map(str::to_owned);
        assert_eq!(
            folded(&texts),
            ["stretch 1.25 to 3.5 s (and 3 more like this)", "other"]
        );
        assert_eq!(folded(&texts[..4]).len(), 4, "three alike are all said");
    }

    #[test]
    fn a_value_has_the_figures_that_its_error_warrants() {
        let shown = [
            (1406.8, Some(2215.1)),
            (-0.294, Some(0.37)),
            (41.06, Some(2.8)),
            (0.0123, None),
        ];
        let shown = shown.map(|(value, std)| with_error(value, std));
        assert_eq!(
            shown,
            ["1400 ± 2200", "-0.29 ± 0.37", "41.1 ± 2.8", "0.0123"]
        );
    }

    #[test]
    fn the_gist_of_a_message_is_what_happened() {
        assert_eq!(
            gist("a misfit: 3 mm/s² (5 times the noise, p = 2e-9). It depends on"),
            "a misfit: 3 mm/s²"
        );
        assert_eq!(
            gist("turn 7 lasts 21 s (t = 1 to 2 s): no rest; if so, vibrated"),
            "turn 7 lasts 21 s (t = 1 to 2 s): no rest"
        );
    }

    #[test]
    fn a_chance_has_one_figure_where_it_is_small_and_never_reads_zero() {
        assert_eq!(chance(0.0), "< 1e-15");
        assert_eq!(chance(3e-238), "< 1e-15");
        assert_eq!(probability(0.0), "p < 1e-15");
        assert_eq!(probability(0.0042), "p = 0.004");
        assert_eq!(chance(3.2e-11), "3e-11");
        assert_eq!(chance(0.0042), "0.004");
    }
}
