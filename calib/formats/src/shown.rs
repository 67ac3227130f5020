//! Names from a file as messages show them.

use std::fmt::Write as _;

/// Characters of a name that a message quotes.
const LONGEST: usize = 80;

/// A name from a file, safe to print: what is not ASCII text escaped, at most [`LONGEST`] characters of it.
pub(crate) fn shown(name: &str) -> String {
    let mut out = String::new();
    let mut chars = name.chars();
    for c in chars.by_ref().take(LONGEST) {
        // Writing to a string does not fail.
        let _ = write!(out, "{}", c.escape_default());
    }
    if chars.next().is_some() {
        out.push('…');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn a_name_is_cut_and_escaped() {
        assert_eq!(shown("acc\n"), "acc\\n");
        assert_eq!(shown(&"x".repeat(1_000_000)).chars().count(), 81);
    }
}
