//! Positions of keys in a TOML text, for messages.

use std::ops::Range;

use findings::{Finding, Front, Kind, Remedy};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Line and column of a byte, counted from 1.
fn line_and_column(text: &str, byte: usize) -> (u64, u64) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |l| l.chars().count()) + 1;
    (line as u64, column as u64)
}

/// The finding at a byte of the text of a file.
fn at_byte(found: Finding, file: &str, text: &str, byte: usize) -> Finding {
    let (line, column) = line_and_column(text, byte);
    found.in_file(file).at_line(line).at_column(column)
}

/// The finding on an entry of the text of a file, where the longest known part of its dotted key stands.
pub fn at_key(found: Finding, file: &str, text: &str, key: &str) -> Finding {
    at_byte(found, file, text, key_position(text, key).unwrap_or(0))
}

/// The parser's refusal of the text of a file, with the nearest of the names it lists.
pub fn not_toml(file: &str, text: &str, error: &toml::de::Error) -> Finding {
    let line = in_one_line(error.message());
    let found = Finding::of(Kind::NOT_TOML).detail("reason", shortened(&line));
    let found = match nearest(&line) {
        Some(remedy) => found.remedy(remedy),
        None => found,
    };
    at_byte(found, file, text, error.span().map_or(0, |span| span.start))
}

/// Characters of a parser's message that are shown before and from the list of known names on, which fits.
const QUOTED: usize = 200;
const KNOWN: usize = 800;

/// The parser's message in one line, with the nearest of the names it lists. What it quotes of the text is cut, as a parser
/// quotes it whole.
///
/// ```
/// let message = format!("unknown field `{}`, expected `device`", "x".repeat(100_000));
/// let shown = stillpoint_recording::explain_toml(&message);
/// assert!(shown.ends_with("x…, expected `device`") && shown.len() < 300);
/// ```
pub fn explain_toml(message: &str) -> String {
    let line = in_one_line(message);
    let hint = nearest(&line).map(|remedy| remedy.text(Front::Plain));
    shortened(&line) + &hint.map_or(String::new(), |hint| format!("; {hint}"))
}

fn in_one_line(message: &str) -> String {
    message.lines().collect::<Vec<_>>().join(" ")
}

/// The nearest of the names that a message lists after the one that it does not know.
fn nearest(line: &str) -> Option<Remedy> {
    let mut quoted = line.split('`').skip(1).step_by(2);
    let found = quoted.next().filter(|_| line.starts_with("unknown "))?;
    Remedy::nearest(found, quoted)
}

/// A message without most of what it quotes of the text.
fn shortened(line: &str) -> String {
    let at = line.rfind(", expected").unwrap_or(line.len());
    let (found, expected) = line.split_at(at);
    cut(found, QUOTED) + &cut(expected, KNOWN)
}

/// The beginning of `text`, at most so many characters of it.
fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => text[..end].to_owned() + "…",
        None => text.to_owned(),
    }
}

/// Returns the byte position in `text` of the longest known part of the dotted `key`.
fn key_position(text: &str, key: &str) -> Option<usize> {
    let table = DeTable::parse(text).ok()?;
    deepest(table.get_ref(), key).map(|span| span.start)
}

/// Parameter names have a dot in them, so that a key of the table may be more than one part.
fn deepest(table: &DeTable, key: &str) -> Option<Range<usize>> {
    let (name, value) = table.iter().find(|(name, _)| {
        let rest = key.strip_prefix(name.get_ref().as_ref());
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    })?;
    let rest = key.get(name.get_ref().len() + 1..).unwrap_or("");
    deepest_in(value, rest).or(Some(name.span()))
}

fn deepest_in(value: &Spanned<DeValue>, key: &str) -> Option<Range<usize>> {
    match value.get_ref() {
        DeValue::Table(table) => deepest(table, key),
        DeValue::Array(items) => {
            let (place, rest) = key.split_once('.').unwrap_or((key, ""));
            let item = items.get(place.parse::<usize>().ok()?)?;
            deepest_in(item, rest).or(Some(item.span()))
        }
        _ => None,
    }
}
