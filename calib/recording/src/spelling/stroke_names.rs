//! Names with their unit and more between strokes: `"AccelX"|"G"|-3.0|3.0|25`.

use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::source::rewrite::rewritten;

/// The unit goes into brackets behind the name.
pub(super) static STROKE_NAMES: Spelling = Spelling {
    spelling: "names with strokes",
    read_as: "names and units",
    of_dates: false,
    change,
};

/// The name of a cell `"name"|"unit"|..` with its unit.
fn name(cell: &str) -> Option<String> {
    let mut parts = cell.trim().split('|');
    let mut quoted = || parts.next()?.trim().strip_prefix('"')?.strip_suffix('"');
    let (name, unit) = (quoted()?, quoted()?);
    Some(match unit.trim().is_empty() {
        true => name.to_owned(),
        false => format!("{name} ({unit})"),
    })
}

/// The names of a line of such cells.
fn header(line: &str) -> Option<String> {
    let names: Option<Vec<String>> = line.split(',').map(name).collect();
    names
        .filter(|names| names.len() > 1)
        .map(|names| names.join(","))
}

fn change(look: &Look) -> Option<Respell> {
    look.lines()
        .any(|line| header(line).is_some())
        .then_some(())?;
    Some(Box::new(|text| {
        rewritten(text, |line, out| {
            let text = std::str::from_utf8(line).unwrap_or_default();
            match header(text).filter(|_| line.contains(&b'|')) {
                Some(names) => out.extend_from_slice(names.as_bytes()),
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
    fn a_unit_between_strokes_is_that_of_the_name() {
        let of = |text: &str| respelt(&STROKE_NAMES, text);
        let text = "\"Utc\"|\"ms\"|0|0|1,\"AccelX\"|\"G\"|-3.0|3.0|25,\"RPM\"|\"\"|0|9|1\n1,0.1,\n";
        assert_eq!(of(text).unwrap(), "Utc (ms),AccelX (G),RPM\n1,0.1,\n");
        assert_eq!(of("\"t\",\"ax\"\n1,2\n"), None);
        assert_eq!(of("| t | ax |\n| 1 | 2 |\n"), None);
    }
}
