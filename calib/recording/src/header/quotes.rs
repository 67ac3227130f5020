//! Quotes that are open where their line ends.

use findings::{Finding, Kind};

/// Builds the finding about a quote that a line leaves open; `below` are the lines after it.
///
/// The next quote below closes it if its cell ends there. Before a digit it opens another cell, and the
/// first was never closed.
pub(crate) fn open_quote<'a>(below: impl Iterator<Item = (u64, &'a [u8])>) -> Finding {
    let next = below
        .filter_map(|(number, line)| Some((number, line, memchr::memchr(b'"', line)?)))
        .next();
    match next {
        Some((end, line, at)) if !continues(&line[at + 1..]) => {
            Finding::of(Kind::QUOTE_OVER_LINES).count("end", end as usize)
        }
        _ => Finding::of(Kind::QUOTE_OPEN),
    }
}

/// True if a cell goes on, or begins, behind a quote.
fn continues(behind: &[u8]) -> bool {
    !matches!(behind.trim_ascii_start(), [] | [b',' | b';', ..]) && !behind.starts_with(b"\t")
}
