//! Where in a TOML text something stands, for messages.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::did_you_mean;

/// Line and column of a byte, counted from 1.
pub fn place(text: &str, byte: usize) -> String {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |l| l.chars().count()) + 1;
    format!("{line}:{column}")
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
    let line = message.lines().collect::<Vec<_>>().join(" ");
    let mut quoted = line.split('`').skip(1).step_by(2);
    let hint = match (line.starts_with("unknown "), quoted.next()) {
        (true, Some(found)) => did_you_mean(found, quoted),
        _ => String::new(),
    };
    let at = line.rfind(", expected").unwrap_or(line.len());
    let (found, expected) = line.split_at(at);
    cut(found, QUOTED) + &cut(expected, KNOWN) + &hint
}

/// The beginning of `text`, at most so many characters of it.
fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => text[..end].to_owned() + "…",
        None => text.to_owned(),
    }
}

/// Where the longest known part of the dotted `key` stands in `text`.
pub fn key_position(text: &str, key: &str) -> Option<usize> {
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
