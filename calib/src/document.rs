//! Documents as they are written to files and to standard output.

use std::fmt::Write as _;

use serde::Serialize;

/// A document as indented JSON with a line end.
///
/// Characters that a terminal may obey are escaped: they stand in strings, where JSON has a way to write them.
///
/// # Errors
/// The document holds what JSON cannot.
pub fn to_json(document: &impl Serialize) -> Result<String, serde_json::Error> {
    let mut text = serde_json::to_string_pretty(document)?;
    text.push('\n');
    if !text.chars().any(is_obeyed) {
        return Ok(text);
    }
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) {
            let _ = write!(escaped, "\\u{:04x}", u32::from(c));
        } else {
            escaped.push(c);
        }
    }
    Ok(escaped)
}

/// True for characters that a terminal or a reader's eye may obey: controls but line ends, marks of writing
/// direction, separators of lines and paragraphs.
pub fn is_obeyed(c: char) -> bool {
    let marks = matches!(c, '\u{200e}' | '\u{200f}' | '\u{061c}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    marks || c.is_control() && c != '\n'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_escaped_and_reads_back() {
        let document = to_json(&["\u{9b}31m\u{7f}\u{1b}"]).unwrap();
        assert!(!document.chars().any(is_obeyed), "{document}");
        let back: Vec<String> = serde_json::from_str(&document).unwrap();
        assert_eq!(back, ["\u{9b}31m\u{7f}\u{1b}"]);
    }
}
