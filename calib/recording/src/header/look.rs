//! The beginning of a text as lines and names, for formats to know it by.

use super::names::role_of;
use super::preface::{is_comment, without_comment_mark};
use crate::recording::options::Role;

findings::tuning! {
    /// Lines looked at.
    LINES: usize = 60;
    /// Lines looked at for a header below a list of settings.
    FAR: usize = 1000;
}

/// The first lines of a text.
#[derive(Debug)]
pub(crate) struct Look {
    lines: Vec<String>,
}

impl Look {
    /// The whole lines of `head`; the last may be cut.
    pub fn at(head: &[u8]) -> Self {
        let text = String::from_utf8_lossy(head);
        let lines = text
            .split(['\n', '\r'])
            .filter(|line| !line.trim().is_empty());
        let lines: Vec<String> = lines.take(FAR.get()).map(str::to_owned).collect();
        Self { lines }
    }

    /// The lines that are not blank.
    pub fn lines(&self) -> impl Iterator<Item = &str> {
        self.far_lines().take(LINES.get())
    }

    /// The same, and as many more as a list of settings may have above the rows.
    pub fn far_lines(&self) -> impl Iterator<Item = &str> {
        self.lines.iter().map(String::as_str)
    }

    /// Returns the header like [`Self::header`], also below a list of settings.
    pub fn far_header(&self, is_header: impl Fn(&[String]) -> bool) -> Option<Vec<String>> {
        self.far_lines().map(cells).find(|names| is_header(names))
    }

    /// Names of columns: the cells of the first line, a comment or not, that `is_header` holds for.
    pub fn header(&self, is_header: impl Fn(&[String]) -> bool) -> Option<Vec<String>> {
        self.lines().map(cells).find(|names| is_header(names))
    }

    /// The cells of the first line that is no comment.
    pub fn first(&self) -> Vec<String> {
        let mut lines = self.lines();
        let first = lines.find(|line| !is_comment(line.as_bytes()) && !line.starts_with("sep="));
        first.map(cells).unwrap_or_default()
    }

    /// The column that [`Self::first`] calls so that it has this role, numbered from 1.
    pub fn column(&self, wanted: Role) -> Option<String> {
        let names = self.first();
        let name = names
            .iter()
            .find(|name| role_of(name, None) == Some(wanted))?;
        numbered(&names, name)
    }
}

/// The cells of a line without quotes, blanks and the mark of a comment, by the separator it holds most of; else by blanks.
pub(crate) fn cells(line: &str) -> Vec<String> {
    let line = String::from_utf8_lossy(without_comment_mark(line.as_bytes())).into_owned();
    let count = |separator: &char| line.matches(*separator).count();
    // A tie goes to the last: semicolons and tabs separate, commas may also be decimal marks.
    let separator = [',', '\t', ';'].into_iter().max_by_key(count);
    let cell = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
    match separator.filter(|separator| count(separator) > 0) {
        Some(separator) => line.split(separator).map(cell).collect(),
        None => line.split_whitespace().map(cell).collect(),
    }
}

/// Returns the number of the column called `name`, counted from 1, as `--columns` takes it.
pub(crate) fn numbered(names: &[String], name: &str) -> Option<String> {
    let at = names.iter().position(|other| other == name)?;
    Some((at + 1).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_behind_marks_and_quotes() {
        let look = Look::at(b"# made by x\n\n\"Time (s)\";\"a, x\"\n0,1;2,5\n");
        let names = look.header(|names| names.len() == 2).unwrap();
        assert_eq!(names, ["Time (s)", "a, x"]);
        assert_eq!(numbered(&names, "a, x").as_deref(), Some("2"));
        assert_eq!(look.first(), names);
        assert_eq!(
            cells("#timestamp [ns],w_RS_S_x"),
            ["timestamp [ns]", "w_RS_S_x"]
        );
    }
}
