//! Lines and cells of a text whose numbers are not understood yet.

use std::ops::Range;

use crate::header::look::Look;
use crate::header::preface::is_comment;

findings::tuning! {
    /// A text with fewer lines is seen as a whole.
    FEW: usize = 100;
}

/// The lines that may be names or rows, but for the last of many, which may be cut.
pub(super) fn lines(look: &Look) -> Vec<&str> {
    let mut lines: Vec<&str> = look.far_lines().filter(|line| may_be_row(line)).collect();
    if lines.len() > FEW.get() {
        lines.pop();
    }
    lines
}

fn may_be_row(line: &str) -> bool {
    !line.trim().is_empty() && !is_comment(line.as_bytes()) && !line.starts_with("sep=")
}

/// The separator that most lines hold as often; `None` where no line has three cells.
pub(super) fn separator(lines: &[&str]) -> Option<char> {
    let steady = |separator: char| {
        let count = |line: &&str| cells(line, separator).len();
        let (width, lines) = most(lines.iter().map(count))?;
        (width > 2).then_some((lines, separator))
    };
    let found = [',', ';', '\t'].into_iter().filter_map(steady);
    // A tie goes to the last: commas may also be decimal marks.
    found.max_by_key(|(lines, _)| *lines).map(|(_, c)| c)
}

/// The number that is there most often, and how often.
pub(super) fn most(numbers: impl Iterator<Item = usize>) -> Option<(usize, usize)> {
    let mut numbers: Vec<usize> = numbers.collect();
    numbers.sort_unstable();
    let runs = numbers.chunk_by(|a, b| a == b);
    let longest = runs.max_by_key(|run| run.len())?;
    Some((*longest.first()?, longest.len()))
}

/// The places of the cells of a line, without blanks and quotes around them.
pub(super) fn cells(line: &str, separator: char) -> Vec<Range<usize>> {
    let mut within = false;
    let parts = line.split(|c: char| {
        within ^= c == '"';
        !within && c == separator
    });
    let begin = |cell: &str| cell.as_ptr() as usize - line.as_ptr() as usize;
    let blank = |c: char| matches!(c, ' ' | '\t' | '\r');
    let place = |cell: &str| {
        let cell = cell.trim_matches(blank);
        let bare = cell.strip_prefix('"').and_then(|c| c.strip_suffix('"'));
        let cell = bare.map_or(cell, |bare| bare.trim_matches(blank));
        begin(cell)..begin(cell) + cell.len()
    };
    parts.map(place).collect()
}

/// The line with other texts in the places of some of its cells, which are in order.
pub(super) fn with_cells(line: &str, changes: &[(Range<usize>, String)], out: &mut Vec<u8>) {
    let mut from = 0;
    for (place, text) in changes {
        out.extend_from_slice(&line.as_bytes()[from..place.start]);
        out.extend_from_slice(text.as_bytes());
        from = place.end;
    }
    out.extend_from_slice(&line.as_bytes()[from..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_are_what_comes_as_often_in_most_lines() {
        let of = |text: &str| separator(&text.lines().collect::<Vec<_>>());
        assert_eq!(of("t;a;b\n1,5;2,5;3\n1;2,5;3\n"), Some(';'));
        assert_eq!(of("t\ta\tb\n1\t1,002.5\t3\n1\t2,300.5\t3\n"), Some('\t'));
        assert_eq!(of("t,a,b\n1,\"1,002.5\",3\n2,\"2\",3\n"), Some(','));
        assert_eq!(of("t a b\n1 2 3\n"), None);
        let line = "1, \" 2,5 \",x ";
        let places = cells(line, ',');
        let words: Vec<&str> = places.iter().map(|at| &line[at.clone()]).collect();
        assert_eq!(words, ["1", "2,5", "x"]);
        let mut out = Vec::new();
        with_cells(line, &[(places[1].clone(), "3".to_owned())], &mut out);
        assert_eq!(out, b"1, \" 3 \",x ");
    }
}
