//! Safe quoting of names, paths and long words from outside in messages.

use std::borrow::Cow;
use std::path::Path;

use calib::document::is_obeyed;

/// The text with control characters shown instead of obeyed: a file name may hold any.
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_obeyed) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    shown.into()
}

/// A path in a message or a title: in one line, at most 200 characters of it.
pub fn path(path: &Path) -> String {
    name(&path.to_string_lossy())
}

/// A name from outside in a message or a title, as [`path`].
pub fn name(name: &str) -> String {
    let shown = printable(name).replace('\n', "\\n");
    match shown.char_indices().nth(QUOTED) {
        Some((end, _)) => format!("{}…", &shown[..end]),
        None => shown,
    }
}

/// Characters of anything that a message quotes.
const QUOTED: usize = 200;

/// Characters at the end of a long word that are kept: `…:12:7:`.
const WORD_END: usize = 24;

/// Characters of a message.
const MESSAGE: usize = 4000;

/// The message with what it quotes cut to 200 characters, and in all to a length that a person can read.
pub fn shortened(message: &str) -> Cow<'_, str> {
    if message.len() <= QUOTED {
        return message.into();
    }
    let quotes = message.split('`').count();
    let mut short = String::new();
    for (k, part) in message.split('`').enumerate() {
        if k > 0 {
            short.push('`');
        }
        // A quote has a mark on either side.
        if k % 2 == 1 && k + 1 < quotes {
            short.push_str(&cut(part, QUOTED, 0));
            continue;
        }
        for word in part.split_inclusive(char::is_whitespace) {
            short.push_str(&cut(word, QUOTED, WORD_END));
        }
    }
    cut(&short, MESSAGE, QUOTED).into_owned().into()
}

/// The first `begin` and the last `end` characters of `text`; all of it where that is hardly more.
fn cut(text: &str, begin: usize, end: usize) -> Cow<'_, str> {
    let count = if text.len() <= begin + end {
        0
    } else {
        text.chars().count()
    };
    if count <= begin + end + 1 {
        return text.into();
    }
    let place = |k: usize| text.char_indices().nth(k).map_or(text.len(), |(at, _)| at);
    format!("{}…{}", &text[..place(begin)], &text[place(count - end)..]).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_shown() {
        assert_eq!(printable("a\u{1b}[2J\u{9b}b\nc"), "a\\u{1b}[2J\\u{9b}b\nc");
        assert_eq!(name("a\n\u{202e}b"), "a\\n\\u{202e}b");
        assert!(matches!(printable("plain °/√h"), Cow::Borrowed(_)));
    }

    #[test]
    fn no_message_quotes_more_than_200_characters_of_anything() {
        let long = "x".repeat(100_000);
        let message =
            shortened(&format!("a.csv:7:1: `{long} y` found and {long}:3:4: z")).into_owned();
        assert!(message.starts_with("a.csv:7:1: `xxx") && message.ends_with("x:3:4: z"));
        assert_eq!(
            message.matches('x').count(),
            200 + 200 + 24 - ":3:4: ".len()
        );
        let names = vec!["name"; 50_000].join(", ");
        assert!(shortened(&names).chars().count() <= MESSAGE + QUOTED + 1);
        assert!(shortened(&format!("it's {long}")).chars().count() < 300);
        assert_eq!(shortened("short"), "short");
    }
}
