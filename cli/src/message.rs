//! Parser of messages for programs: the place at the beginning and the advice at the end.

/// `file:line:column` at the beginning of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place<'a> {
    /// The file.
    pub file: &'a str,
    /// Its line, counted from 1.
    pub line: u64,
    /// The column in bytes, counted from 1.
    pub column: Option<u64>,
    /// Text after the place.
    pub what: &'a str,
}

impl<'a> Place<'a> {
    /// The place that `message` begins with, if it does.
    pub fn of(message: &'a str) -> Option<Self> {
        let colons = message.match_indices(':');
        colons.filter(|(at, _)| *at > 0).find_map(|(at, _)| {
            if message[..at].contains(": ") {
                return None;
            }
            let (line, rest) = number(&message[at + 1..])?;
            let rest = rest.strip_prefix(':')?;
            let column = number(rest).filter(|(_, rest)| rest.starts_with(": "));
            let what = column.map_or(rest, |(_, rest)| &rest[1..]);
            (column.is_some() || rest.starts_with(' ')).then(|| Self {
                file: &message[..at],
                line,
                column: column.map(|(column, _)| column),
                what: what.trim_start(),
            })
        })
    }
}

/// The whole number that `text` begins with, and what follows it.
fn number(text: &str) -> Option<(u64, &str)> {
    let end = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    Some((text[..end].parse().ok()?, &text[end..]))
}

/// Returns the advice in a message: the text after its last semicolon, if it begins with a word of advice.
pub fn advice(message: &str) -> Option<&str> {
    let (_, advice) = message.rsplit_once("; ")?;
    let advice = advice.trim();
    let first = advice.split([' ', ',', ':']).next().unwrap_or("");
    ADVICE.contains(&first).then_some(advice)
}

/// Words that advice begins with.
const ADVICE: [&str; 39] = [
    "add",
    "allow",
    "calibrate",
    "check",
    "choose",
    "cut",
    "delete",
    "did",
    "download",
    "export",
    "fetch",
    "give",
    "leave",
    "make",
    "name",
    "nearest",
    "pipe",
    "raise",
    "record",
    "remove",
    "rotate",
    "run",
    "save",
    "say",
    "see",
    "set",
    "split",
    "take",
    "turn",
    "try",
    "unpack",
    "use",
    "wait",
    "write",
    "--max-rows",
    "--max-bytes",
    "--na",
    "--skip-bad-rows",
    "--sort-time",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_what_a_message_begins_with() {
        let place = |message| Place::of(message).map(|p| (p.file, p.line, p.column));
        assert_eq!(place("a.csv:2:7: `x` found"), Some(("a.csv", 2, Some(7))));
        assert_eq!(place("a.csv:2: more than"), Some(("a.csv", 2, None)));
        assert_eq!(
            place("C:\\a:b.csv:2:7: x"),
            Some(("C:\\a:b.csv", 2, Some(7)))
        );
        assert_eq!(place("a.csv: at 12:30:00 and"), None);
        assert_eq!(place("no place"), None);
    }

    #[test]
    fn advice_is_what_a_message_ends_with() {
        let split = "5 cells, 7 expected; split it here";
        assert_eq!(advice(split), Some("split it here"));
        assert_eq!(advice("all static; nothing turned"), None);
    }
}
