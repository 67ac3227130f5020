//! Quotes that are open where their line ends.

/// What is wrong with a quote that a line leaves open, in words; `below` are the lines after it.
///
/// The next quote below closes it if its cell ends there. Before a digit it opens another cell, and the
/// first was never closed.
pub(crate) fn open_quote<'a>(below: impl Iterator<Item = (u64, &'a [u8])>) -> String {
    let next = below
        .filter_map(|(number, line)| Some((number, line, memchr::memchr(b'"', line)?)))
        .next();
    match next {
        Some((end, line, at)) if !continues(&line[at + 1..]) => format!(
            "a quote is opened here and closed in line {end}: a cell with a line break, where a row is one \
             line; take its line breaks out, or the column",
        ),
        _ => "a quote is opened here and never closed".to_owned(),
    }
}

/// True if a cell goes on, or begins, behind a quote.
fn continues(behind: &[u8]) -> bool {
    !matches!(behind.trim_ascii_start(), [] | [b',' | b';', ..]) && !behind.starts_with(b"\t")
}
