//! Rows in a frame: `| 0.01 | 0.2 |` of databases and Markdown, `(0.01, 0.2)` of Python, `0.01,0.2;` with a mark at their end.

use super::cells::most;
use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::source::rewrite::rewritten;

/// A table with more than separators around its cells.
pub(super) static FRAMED: Spelling = Spelling {
    spelling: "frames around rows",
    read_as: "rows",
    of_dates: false,
    change,
};

findings::tuning! {
    /// Rows that show a frame.
    FEWEST: usize = 10;
}

/// Marks that enclose rows, each with its end.
const ENCLOSING: [(&str, &str); 3] = [("(", ")"), ("[", "]"), ("", ";")];

/// The frame around most rows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Frame {
    /// Strokes between the cells, and perhaps at both ends.
    Strokes,
    /// One of [`ENCLOSING`].
    Enclosed(usize),
}

/// True for the rule between names and rows: `|---|---|`, `+-----+`.
fn is_rule(line: &str) -> bool {
    let line = line.trim();
    line.contains("--") && line.chars().all(|c| "|+-: =".contains(c))
}

/// True for what psql says behind its rows: `(6240 rows)`.
fn is_count(line: &str) -> bool {
    let count = line.trim().strip_prefix('(');
    let count = count.and_then(|rest| rest.strip_suffix(" rows)"));
    count.is_some_and(|count| count.bytes().all(|byte| byte.is_ascii_digit()))
}

/// The line without what encloses it.
fn within(line: &str, at: usize) -> Option<&str> {
    let (begin, end) = ENCLOSING[at];
    let line = line.trim().strip_prefix(begin)?.strip_suffix(end)?;
    (!line.contains(begin) || begin.is_empty()).then_some(line)
}

fn frame(look: &Look) -> Option<Frame> {
    let lines: Vec<&str> = look.far_lines().filter(|line| !is_rule(line)).collect();
    // A line may be cut at the end of what is looked at.
    let whole = &lines[..lines
        .len()
        .saturating_sub(usize::from(lines.len() > 2 * FEWEST.get()))];
    let strokes = whole.iter().map(|line| line.matches('|').count());
    let is_most = |count: usize| count >= FEWEST.get() && 10 * count >= 9 * whole.len();
    if let Some((strokes, count)) = most(strokes)
        && strokes >= 3
        && is_most(count)
        && !whole.iter().any(|line| line.contains([';', '=']))
    {
        return Some(Frame::Strokes);
    }
    let are_numbers = |line: &str| {
        let mut cells = line.split([',', ' ', '\t']).filter(|cell| !cell.is_empty());
        let last = cells
            .next_back()
            .is_some_and(|cell| cell.parse::<f64>().is_ok());
        last && cells.count() >= 2
    };
    let encloses = |at: &usize| {
        let rows = whole.iter().filter_map(|line| within(line, *at));
        let rows = rows.filter(|row| are_numbers(row) && !row.contains(';'));
        is_most(rows.count())
    };
    (0..ENCLOSING.len()).find(encloses).map(Frame::Enclosed)
}

fn change(look: &Look) -> Option<Respell> {
    let frame = frame(look)?;
    Some(Box::new(move |text| {
        rewritten(text, move |line, out| {
            let text = std::str::from_utf8(line).unwrap_or_default();
            match frame {
                Frame::Strokes if is_rule(text) || is_count(text) => {}
                Frame::Strokes => {
                    let row = text.trim();
                    let row = row.strip_prefix('|').unwrap_or(row);
                    let row = row.strip_suffix('|').unwrap_or(row);
                    out.extend_from_slice(row.replace('|', ";").as_bytes());
                }
                Frame::Enclosed(at) => {
                    let row = within(text, at).map_or(line, str::as_bytes);
                    out.extend_from_slice(row);
                }
            }
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    fn first_and_last(header: &str, row: &str) -> Option<(String, String)> {
        let text = header.to_owned() + &format!("{row}\n").repeat(20);
        let read = respelt(&FRAMED, &text)?;
        assert_eq!(read.lines().count(), text.lines().count());
        Some((
            read.lines().next()?.to_owned(),
            read.lines().last()?.to_owned(),
        ))
    }

    #[test]
    fn frames_are_taken_off() {
        let of = |first: &str, last: &str| Some((first.to_owned(), last.to_owned()));
        let read = first_and_last("| t | ax | ay |\n|---|----|----|\n", "| 0 | 1.5 | 2 |");
        assert_eq!(read, of(" t ; ax ; ay ", " 0 ; 1.5 ; 2 "));
        let read = first_and_last("t|ax|ay|az\n", "0|1.5|2|3");
        assert_eq!(read, of("t;ax;ay;az", "0;1.5;2;3"));
        let read = first_and_last("", "(0, 1.5, 2)");
        assert_eq!(read, of("0, 1.5, 2", "0, 1.5, 2"));
        let read = first_and_last("t,ax,ay\n", "0,1.5,2;");
        assert_eq!(read, of("t,ax,ay", "0,1.5,2"));
    }

    #[test]
    fn rows_without_a_frame_are_left_alone() {
        for row in [
            "0,1,2",
            "0;1;2;",
            "[12] 1 2 3",
            "aX = 1 | aY = 2 | aZ = 3 | b = 1",
            "(1,2),(3,4)",
        ] {
            assert_eq!(first_and_last("t,a,b\n", row), None, "{row}");
        }
    }
}
