//! Numbers with separators of thousands that are never decimal marks: `1'000.5`, `10 006,7`. Points and commas between thousands are
//! refused where they are read, for one of them is the decimal mark of another file.

use std::collections::BTreeSet;

use super::cells::{cells, lines, separator, with_cells};
use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::source::rewrite::rewritten;

/// Numbers that cannot be read in another way have such separators.
pub(super) static GROUPED: Spelling = Spelling {
    spelling: "numbers with thousands separators",
    read_as: "numbers without",
    of_dates: false,
    change,
};

/// Marks between groups that are never decimal marks: apostrophes and blanks.
const APART: [char; 6] = ['\'', '\u{2019}', '\u{a0}', '\u{202f}', '\u{2009}', ' '];

/// Kinds of numbers by their marks.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    /// A whole number.
    Whole,
    /// Groups between this mark, which can be nothing else.
    Grouped(char),
    /// One blank before three digits: three numbers of three digits may share a cell.
    Perhaps(char),
    /// A decimal mark.
    Decimal(char),
}

/// The kind of number in `cell`; `None` for no number.
fn number(cell: &str) -> Option<Number> {
    let digits = cell.trim_start_matches(['+', '-', '\u{2212}']);
    let is_mark = |c: char| matches!(c, '.' | ',') || APART.contains(&c);
    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let mut others = digits.chars().filter(|c| !c.is_ascii_digit());
    let Some(first) = others.next() else {
        return Some(Number::Whole);
    };
    let marks: Vec<char> = std::iter::once(first).chain(others).collect();
    if !marks.iter().all(|c| is_mark(*c)) {
        return None;
    }
    let groups: Vec<&str> = digits.split(is_mark).collect();
    let last = marks[marks.len() - 1];
    let decimals = (last != first || APART.contains(&last)) && matches!(last, '.' | ',');
    let whole = &groups[..groups.len() - usize::from(decimals)];
    let own = &marks[..marks.len() - usize::from(decimals)];
    let are_groups = whole[1..].iter().all(|group| group.len() == 3)
        && (1..=3).contains(&whole[0].len())
        && !whole[0].starts_with('0')
        && own.iter().all(|mark| *mark == first);
    match own.len() {
        0 => Some(Number::Decimal(first)),
        _ if !are_groups && marks.len() == 1 => Some(Number::Decimal(first)),
        _ if !are_groups => None,
        _ if !APART.contains(&first) => None,
        _ if !decimals && first == ' ' => Some(Number::Perhaps(first)),
        _ => Some(Number::Grouped(first)),
    }
}

/// The mark between thousands in a text, and its separator.
fn mark(look: &Look) -> Option<(char, char)> {
    let lines = lines(look);
    let separator = separator(&lines)?;
    let rows: Vec<Vec<Option<Number>>> = lines
        .iter()
        .map(|line| {
            let places = cells(line, separator).into_iter();
            places.map(|at| number(&line[at])).collect()
        })
        .collect();
    let all = || rows.iter().flatten().flatten();
    let certain: BTreeSet<char> = all()
        .filter_map(|number| match number {
            Number::Grouped(mark) => Some(*mark),
            _ => None,
        })
        .collect();
    let mark = match certain.len() {
        0 => return None,
        1 => *certain.first()?,
        _ => return None,
    };
    // The same mark before decimals.
    let is_decimal = all().any(|number| *number == Number::Decimal(mark));
    (!is_decimal).then_some((mark, separator))
}

fn change(look: &Look) -> Option<Respell> {
    let (mark, separator) = mark(look)?;
    Some(Box::new(move |text| {
        rewritten(text, move |line, out| {
            let Ok(text) = std::str::from_utf8(line) else {
                return out.extend_from_slice(line);
            };
            let is_grouped = |at: &std::ops::Range<usize>| matches!(number(&text[at.clone()]), Some(Number::Grouped(found) | Number::Perhaps(found)) if found == mark);
            let grouped = cells(text, separator).into_iter().filter(is_grouped);
            let changes: Vec<_> = grouped
                .map(|at| (at.clone(), text[at].replace(mark, "")))
                .collect();
            with_cells(text, &changes, out);
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    #[test]
    fn groups_that_nothing_else_can_be_are_joined() {
        for (text, expected) in [
            (
                "t;a;b\n1'010;-9'806.65;102.5\n",
                "t;a;b\n1010;-9806.65;102.5\n",
            ),
            (
                "t;a;b\n10\u{202f}010;9 806,65;2,5\n",
                "t;a;b\n10\u{202f}010;9 806,65;2,5\n",
            ),
            ("t;a;b\n10;9\u{a0}806,65;2,5\n", "t;a;b\n10;9806,65;2,5\n"),
        ] {
            let read = respelt(&GROUPED, text);
            assert_eq!(read.as_deref().unwrap_or(text), expected);
        }
    }

    #[test]
    fn decimals_are_left_alone() {
        for text in [
            "t;a;b\n1.010;-9.806;102.500\n",
            "t;a;b\n1.010;-9.806,65;102,5\n",
            "t,a,b\n1,\"9,806.65\",2.5\n",
            "t;a;b\n0.500;9.806,65;1\n",
            "t;a;b\n1,010;2,5;1.250\n",
            "t,a,b\n1,2,3\n4,5,6\n",
            "t;a;b\n2026.11.21;10:00:00;1,5\n",
        ] {
            assert_eq!(respelt(&GROUPED, text), None, "{text}");
        }
    }
}
