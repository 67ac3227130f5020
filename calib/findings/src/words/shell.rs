//! Words as a shell reads them.

/// Characters of a word that no shell changes.
fn is_plain(c: char) -> bool {
    c.is_alphanumeric() || "/._-+=:,@%^".contains(c)
}

/// A word as a shell reads it.
pub(crate) fn quoted(word: &str) -> String {
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}
