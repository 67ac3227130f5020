//! Names, paths and numbers from outside as messages show them.

use std::fmt::Write;
use std::path::Path;

pub use findings::significant;

/// A name from outside, safe to print: control characters escaped, at most 200 characters.
pub fn shown(name: &str) -> String {
    shown_to(name, 200)
}

/// Returns the content of a cell, safe to print, at most 40 characters of it.
pub(crate) fn shown_cell(cell: &[u8]) -> String {
    shown_to(&String::from_utf8_lossy(cell), 40)
}

/// Names from outside in a list, safe to print: as many as go into 200 characters, and how many more.
pub(crate) fn shown_list<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let mut out = String::new();
    let mut names = names.peekable();
    while let Some(name) = names.next() {
        let mark = if out.is_empty() { "" } else { ", " };
        let _ = write!(out, "{mark}`{}`", shown_to(name, 60));
        let more = names.peek().is_some() && out.chars().count() > 150;
        if more {
            let _ = write!(out, " and {} more", names.count());
            break;
        }
    }
    out
}

fn shown_to(name: &str, limit: usize) -> String {
    let mut out = String::new();
    for (count, c) in name.chars().enumerate() {
        if count == limit {
            out.push('…');
            break;
        }
        if c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}') {
            let _ = write!(out, "{}", c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

/// A number in the fewest digits that tell it from its neighbours, with an exponent where it is long.
pub fn figure(value: f64) -> String {
    let is_short = value == 0.0 || !value.is_finite() || (1e-4..1e9).contains(&value.abs());
    if is_short {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A path, safe to print.
pub fn shown_path(path: &Path) -> String {
    shown(&path.to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::{figure, shown_list, significant};

    #[test]
    fn significant_digits_are_rounded_and_end_without_zeros() {
        let shown = [49.982_736, 0.050_01, 12_345.6, 100.0].map(|v| significant(v, 3));
        assert_eq!(shown, ["50", "0.05", "12300", "100"]);
    }

    #[test]
    fn a_list_of_names_is_cut_and_says_so() {
        let names = |count| (0..count).map(|k| format!("name{k}")).collect::<Vec<_>>();
        assert_eq!(shown_list(names(2).iter()), "`name0`, `name1`");
        let list = shown_list(names(100_000).iter());
        assert!(list.len() < 200 && list.ends_with(" more"), "{list}");
        assert!(shown_list(["x".repeat(100_000)].iter()).chars().count() < 70);
    }

    #[test]
    fn no_number_is_longer_than_a_double_needs() {
        let cases = [
            (98.1, "98.1"),
            (0.0, "0"),
            (1e300, "1e300"),
            (-2.5e-7, "-2.5e-7"),
        ];
        for (value, text) in cases {
            assert_eq!(figure(value), text);
        }
        assert!(figure(-f64::MIN_POSITIVE).len() <= 24);
    }
}
