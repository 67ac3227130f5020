//! The words and the numbers of a message of a serial log.

use crate::spelling::number_with_unit;

/// The words and the numbers of a message, without what separates them.
pub(super) fn words(message: &str) -> impl Iterator<Item = &str> {
    let is_json = message.trim_start().starts_with('{');
    // `IMU {AccX : 1, ..}`, `Accel: {'x': 1, ..}`.
    let is_in_braces = is_json || (message.contains('{') && message.trim_end().ends_with('}'));
    let separates = move |c: char| {
        matches!(
            c,
            ',' | ';' | ' ' | '\t' | ':' | '=' | '|' | '(' | ')' | '[' | ']'
        ) || (is_in_braces && matches!(c, '{' | '}' | '"' | '\''))
    };
    // Dashes and arrows between names and numbers say nothing.
    let is_mark = |word: &str| word.is_empty() || matches!(word, "-" | "–" | ">" | "->");
    message.split(separates).filter(move |word| !is_mark(word))
}

/// The axis that a letter is of.
pub(super) fn axis_of_letter(word: &str) -> Option<usize> {
    ["x", "y", "z"]
        .iter()
        .position(|axis| word.eq_ignore_ascii_case(axis))
}

/// A number as it is written, and a whole one that InfluxDB marks, `12i`, without its mark.
pub(super) fn number(word: &str) -> Option<&str> {
    let is_number = |word: &str| word.parse::<f64>().is_ok_and(f64::is_finite);
    let whole = word
        .strip_suffix('i')
        .filter(|own| own.parse::<i64>().is_ok());
    whole.or_else(|| is_number(word).then_some(word))
}

/// Units of other quantities than a sensor's.
const OTHERS: [&str; 8] = ["°", "%", "C", "F", "V", "A", "Hz", "hPa"];

/// A number and the unit that stands behind it without a blank, `0.01g`.
pub(super) fn with_unit(word: &str) -> Option<(&str, &str)> {
    let of_another = || {
        let unit = OTHERS.iter().find(|unit| word.ends_with(**unit))?;
        Some((&word[..word.len() - unit.len()], *unit))
    };
    let found = number_with_unit(word).or_else(of_another);
    found.filter(|(digits, _)| number(digits).is_some())
}
