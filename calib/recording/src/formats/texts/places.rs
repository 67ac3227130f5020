//! The places of the cells of a line, for changing one of them.

use std::ops::Range;

use crate::header::look::Look;
use crate::header::preface::is_comment;

findings::tuning! {
    /// A text with fewer lines is seen as a whole.
    FEW: usize = 100;
}

/// The places of the cells of a line, without blanks and quotes around them: between the separators that it holds most of, else
/// between blanks.
pub(crate) fn places(line: &str) -> Vec<Range<usize>> {
    let count = |separator: char| (line.matches(separator).count(), separator);
    let most = [',', '\t', ';']
        .into_iter()
        .map(count)
        .max_by_key(|(count, _)| *count);
    let separator = most
        .filter(|(count, _)| *count > 0)
        .map_or(' ', |(_, separator)| separator);
    let begin = |cell: &str| cell.as_ptr() as usize - line.as_ptr() as usize;
    let place = |cell: &str| {
        let cell = cell.trim().trim_matches('"').trim();
        let begin = begin(cell);
        begin..begin + cell.len()
    };
    let all = line.split(separator).map(place);
    all.filter(|place| separator != ' ' || !place.is_empty())
        .collect()
}

/// The cells of a line.
pub(crate) fn words(line: &str) -> Vec<&str> {
    places(line).into_iter().map(|at| &line[at]).collect()
}

/// The line with another text in place of one.
pub(crate) fn replaced(line: &str, place: &Range<usize>, text: &str) -> String {
    format!("{}{text}{}", &line[..place.start], &line[place.end..])
}

/// True for a line that may be names or a row.
pub(crate) fn may_be_row(line: &str) -> bool {
    !line.trim().is_empty() && !is_comment(line.as_bytes()) && !line.starts_with("sep=")
}

/// The lines at the beginning of a text that may be names or rows, but for the last of many, which may be cut.
pub(crate) fn whole_rows(look: &Look) -> Vec<&str> {
    let mut lines: Vec<&str> = look.far_lines().filter(|line| may_be_row(line)).collect();
    if lines.len() > FEW.get() {
        lines.pop();
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_found_and_changed_in_their_place() {
        for (line, changed) in [
            ("a, \"bc\" ,d", "a, \"X\" ,d"),
            ("a;bc;d,e", "a;X;d,e"),
            ("a  bc d", "a  X d"),
            ("a,,d", "a,X,d"),
        ] {
            let places = places(line);
            assert_eq!(places.len(), 3, "{line}");
            assert_eq!(replaced(line, &places[1], "X"), changed);
        }
    }
}
