//! Rows that begin with a stamp in brackets, as `[12.345] 1 2 3` and `[2026-05-01 12:00:00.010] 1,2,3`.

use std::io::Read;

use super::text_format::TextFormat;
use crate::clock::time_of_day::{TimeOfDay, seconds};
use crate::header::look::Look;
use crate::header::names::role_of;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;

/// A log whose rows begin with a number, a date or a time of day in brackets.
pub(crate) static BRACKETS: TextFormat = TextFormat {
    name: "brackets",
    about: "rows that begin with a stamp in brackets: `[12.345] 1 2 3`",
    parts,
};

findings::tuning! {
    /// Cells of a row behind its stamp.
    FEWEST: usize = 3;
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let rows = look.lines().filter(|line| split(line).is_some()).count();
    let part = Part {
        change: Some(change),
        ..Part::default()
    };
    (2 * rows > look.lines().count()).then(|| vec![part])
}

/// The stamp of a row, and the numbers behind it.
fn split(line: &str) -> Option<(&str, &str)> {
    let (stamp, rest) = line.trim_start().strip_prefix('[')?.split_once(']')?;
    let stamp = stamp.trim();
    let is_date = stamp.starts_with(|c: char| c.is_ascii_digit()) && stamp.contains(':');
    if !is_date && stamp.parse::<f64>().is_err() {
        return None;
    }
    let rest = rest.trim_start_matches(|c: char| c.is_whitespace() || ",;:".contains(c));
    let separates = |c: char| c.is_whitespace() || c == ';' || c == ',';
    let mut words = rest.split(separates).filter(|word| !word.is_empty());
    let numbers = words.by_ref().take(FEWEST.get());
    let are_numbers = numbers.filter(|word| word.parse::<f64>().is_ok()).count() == FEWEST.get();
    are_numbers.then_some((stamp, rest))
}

/// Returns the separator between the cells of a row; `None` for blanks.
fn separator(cells: &str) -> Option<char> {
    [';', '\t', ',']
        .into_iter()
        .find(|separator| cells.contains(*separator))
}

/// The rows with their stamps as first cells, and a header that lacks the stamp's name with it.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut clock = TimeOfDay::default();
    let mut begun = false;
    rewritten(text, move |line, out| {
        let Ok(text) = std::str::from_utf8(line) else {
            return out.extend_from_slice(line);
        };
        let Some((stamp, rest)) = split(text) else {
            let first = text.split([',', ';', '\t', ' ']).next().unwrap_or_default();
            let is_header = !begun && first.starts_with(char::is_alphabetic);
            if is_header && role_of(first, None).is_some_and(|role| role != Role::Time) {
                let separator = separator(text).unwrap_or(' ');
                out.extend_from_slice(format!("time{separator}").as_bytes());
            }
            return out.extend_from_slice(line);
        };
        begun = true;
        let stamp = match seconds(stamp).and_then(|_| clock.read(stamp)) {
            Some(seconds) => format!("{seconds:.6}"),
            None => stamp.replace(' ', "T"),
        };
        let row = match separator(rest) {
            Some(separator) => format!("{stamp}{separator}{rest}"),
            None => format!("{stamp} {rest}"),
        };
        out.extend_from_slice(row.as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn changed(text: &str) -> String {
        changed_by(change, text)
    }

    #[test]
    fn stamps_become_the_first_cells() {
        assert_eq!(
            changed("[  1.5] 1 2 3\n[2.5]: 1 2 3\n"),
            "1.5 1 2 3\n2.5 1 2 3\n"
        );
        assert_eq!(
            changed("[2026-05-01 12:00:00.1] 1,2,3\n"),
            "2026-05-01T12:00:00.1,1,2,3\n"
        );
        let rows = changed("ax\tay\taz\n[00:00:01.5]\t1\t2\t3\n");
        assert_eq!(rows, "time\tax\tay\taz\n1.500000\t1\t2\t3\n");
    }

    #[test]
    fn words_behind_brackets_are_no_row() {
        let log = "[INFO] [17.5]: acc 1 2 3\n[12.5] started\n[]\n";
        assert!(parts(&Look::at(log.as_bytes())).is_none());
        assert!(parts(&Look::at(b"[1.5] 1 2 3\n[2.5] 1 2 3\n")).is_some());
    }
}
