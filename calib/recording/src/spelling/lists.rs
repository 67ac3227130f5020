//! Rows with lists in their cells: `0.01,"[0.1, 0.2, 9.8]"` of pandas, `(0.01, (0.1, 0.2, 9.8))` of Python, `{""x"":0.1,..}`.

use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::source::rewrite::rewritten;

/// The numbers of a list become cells, and the name of its column that of each.
pub(super) static LISTS: Spelling = Spelling {
    spelling: "lists in cells",
    read_as: "cells",
    of_dates: false,
    change,
};

findings::tuning! {
    /// Rows that show lists.
    FEWEST: usize = 10;
}

/// Separators between cells, those that are sure first.
const SEPARATORS: [char; 4] = [';', '\t', ',', ' '];

/// A cell of a row.
enum Cell<'a> {
    Plain(&'a str),
    /// The numbers of a list, and their keys where they have some.
    List(Vec<(Option<&'a str>, &'a str)>),
}

/// The cells of a line by a separator that stands neither in brackets nor in quotes; `None` where a bracket is not closed.
fn split(line: &str, separator: char) -> Option<Vec<&str>> {
    let (mut depth, mut is_quoted, mut begin) = (0_usize, false, 0);
    let mut cells = Vec::new();
    for (at, c) in line.char_indices() {
        match c {
            '"' if depth == 0 => is_quoted = !is_quoted,
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.checked_sub(1)?,
            _ if c == separator && depth == 0 && !is_quoted => {
                cells.push(line[begin..at].trim());
                begin = at + c.len_utf8();
            }
            _ => {}
        }
    }
    cells.push(line[begin..].trim());
    (depth == 0 && !is_quoted).then(|| {
        cells
            .into_iter()
            .filter(|cell| separator != ' ' || !cell.is_empty())
            .collect()
    })
}

/// The text within brackets.
fn enclosed(text: &str) -> Option<&str> {
    let inner = ["()", "[]", "{}"].into_iter().find_map(|pair| {
        let inner = text.strip_prefix(&pair[..1])?;
        inner.strip_suffix(&pair[1..])
    });
    inner.map(str::trim)
}

fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok()
}

fn cell(text: &str) -> Option<Cell<'_>> {
    let text = text.trim_matches('"');
    let Some(inner) = enclosed(text) else {
        return (!text.contains(['(', '[', '{'])).then_some(Cell::Plain(text));
    };
    let separates = |c: char| c == ',' || c == ';' || c.is_whitespace();
    // `x: 0.1` is one.
    let parts: Vec<&str> = match inner.contains(':') {
        true => inner.split(',').collect(),
        false => inner
            .split(separates)
            .filter(|part| !part.is_empty())
            .collect(),
    };
    let is_keyed = parts.iter().all(|part| part.contains(':'));
    let numbers = parts.into_iter().map(|part| {
        let (key, number) = match part.split_once(':').filter(|_| is_keyed) {
            Some((key, number)) => (Some(key.trim().trim_matches(['"', '\''])), number.trim()),
            None => (None, part.trim()),
        };
        is_number(number).then_some((key, number))
    });
    let numbers: Vec<_> = numbers.collect::<Option<_>>()?;
    (numbers.len() > 1).then_some(Cell::List(numbers))
}

/// A row, without brackets around it; `None` for other lines.
fn row(line: &str, separator: char) -> Option<Vec<Cell<'_>>> {
    let line = line.trim().trim_end_matches(',');
    let whole = split(line, separator)?;
    let inner = || split(enclosed(line)?, separator);
    let cells = match whole.len() {
        1 => inner()?,
        _ => whole,
    };
    let cells: Vec<Cell> = cells.into_iter().map(cell).collect::<Option<_>>()?;
    let has_list = cells.iter().any(|cell| matches!(cell, Cell::List(_)));
    let is_plain = |cell: &Cell| matches!(cell, Cell::Plain(text) if !is_number(text));
    (has_list && (separator != ' ' || !cells.iter().any(is_plain))).then_some(cells)
}

/// Numbers of each cell.
fn shape(cells: &[Cell]) -> Vec<usize> {
    let count = |cell: &Cell| match cell {
        Cell::Plain(_) => 0,
        Cell::List(numbers) => numbers.len(),
    };
    cells.iter().map(count).collect()
}

/// The cells of a row, one for each number.
fn flat(cells: &[Cell], separator: char) -> String {
    let numbers = |cell: &Cell| match cell {
        Cell::Plain(text) => (*text).to_owned(),
        Cell::List(numbers) => {
            let numbers: Vec<&str> = numbers.iter().map(|(_, number)| *number).collect();
            numbers.join(&separator.to_string())
        }
    };
    let cells: Vec<String> = cells.iter().map(numbers).collect();
    cells.join(&separator.to_string())
}

/// The names of the columns, one for each number of the lists in `cells`.
fn names(header: &[&str], cells: &[Cell], separator: char) -> String {
    let name = |(name, cell): (&&str, &Cell)| match cell {
        Cell::Plain(_) => (*name).to_owned(),
        Cell::List(numbers) => {
            let name = name.trim_matches('"');
            let axis = |(at, (key, _)): (usize, &(Option<&str>, &str))| {
                let axis = ["x", "y", "z"].get(at).filter(|_| numbers.len() == 3);
                match key.or(axis.copied()) {
                    Some(axis) => format!("{name}.{axis}"),
                    None => format!("{name}.{}", at + 1),
                }
            };
            let all: Vec<String> = numbers.iter().enumerate().map(axis).collect();
            all.join(&separator.to_string())
        }
    };
    let names: Vec<String> = header.iter().zip(cells).map(name).collect();
    names.join(&separator.to_string())
}

fn change(look: &Look) -> Option<Respell> {
    let lines: Vec<&str> = look.far_lines().collect();
    if !lines.iter().any(|line| line.contains(['(', '[', '{'])) {
        return None;
    }
    let is_of = |separator: &char| {
        let rows = lines.iter().filter_map(|line| row(line, *separator));
        let shapes: Vec<Vec<usize>> = rows.map(|cells| shape(&cells)).collect();
        let alike = shapes.iter().filter(|other| *other == &shapes[0]).count();
        alike >= FEWEST.get() && 10 * alike >= 9 * lines.len()
    };
    let separator = SEPARATORS.into_iter().find(|separator| is_of(separator))?;
    let first = lines.iter().find_map(|line| row(line, separator))?;
    let wanted = shape(&first);
    let header = lines.first().filter(|line| row(line, separator).is_none());
    let named = header.and_then(|line| {
        let cells = split(line.trim(), separator).filter(|cells| cells.len() == first.len())?;
        Some((line.trim().to_owned(), names(&cells, &first, separator)))
    });
    Some(Box::new(move |text| {
        rewritten(text, move |line, out| {
            let text = std::str::from_utf8(line).unwrap_or_default();
            let header = named.as_ref().filter(|(header, _)| text.trim() == header);
            if let Some((_, names)) = header {
                return out.extend_from_slice(names.as_bytes());
            }
            match row(text, separator).filter(|cells| shape(cells) == wanted) {
                Some(cells) => out.extend_from_slice(flat(&cells, separator).as_bytes()),
                None => out.extend_from_slice(line),
            }
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    #[test]
    fn lists_in_cells_become_cells() {
        for (header, row, names, numbers) in [
            (
                "t,acc",
                "0.1,\"[1, 2, 3]\"",
                "t,acc.x,acc.y,acc.z",
                "0.1,1,2,3",
            ),
            (
                "t;acc",
                "0.1;\"{\"\"x\"\":1,\"\"y\"\":2,\"\"z\"\":3}\"",
                "t;acc.x;acc.y;acc.z",
                "0.1;1;2;3",
            ),
            (
                "t,q,acc",
                "0.1,(1 2 3 4),[1 2 3]",
                "t,q.1,q.2,q.3,q.4,acc.x,acc.y,acc.z",
                "0.1,1,2,3,4,1,2,3",
            ),
        ] {
            let text = format!("{header}\n") + &format!("{row}\n").repeat(12);
            let read = respelt(&LISTS, &text).unwrap();
            assert_eq!(read.lines().next(), Some(names));
            assert_eq!(read.lines().last(), Some(numbers));
        }
        for row in [
            "(0.1, (1, 2, 3), (4, 5, 6))",
            "[0.1, [1, 2, 3], [4, 5, 6]],",
        ] {
            let read = respelt(&LISTS, &format!("{row}\n").repeat(12)).unwrap();
            assert_eq!(read.lines().last(), Some("0.1,1,2,3,4,5,6"));
        }
    }

    #[test]
    fn other_brackets_are_left_alone() {
        for row in [
            "[12.5] 1,2,3",
            "acc (1, 2, 3) gyro (4, 5, 6)",
            "(1,2,3)",
            "1,2,3",
            "0.1,[1,2",
            "t [s],ax (g)",
        ] {
            assert_eq!(
                respelt(&LISTS, &format!("{row}\n").repeat(12)),
                None,
                "{row}"
            );
        }
    }
}
