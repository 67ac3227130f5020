//! A way to spell numbers, and the change of a text that is spelt so.

use std::io::Read;

use crate::header::look::Look;

/// A change of a text that keeps its lines.
pub(crate) type Respell = Box<dyn FnOnce(Box<dyn Read + Send>) -> Box<dyn Read + Send>>;

/// A way to spell numbers.
#[derive(Debug)]
pub(crate) struct Spelling {
    /// The spelling, in a remark.
    pub spelling: &'static str,
    /// The reading of it, in a remark.
    pub read_as: &'static str,
    /// True where a format of dates that is given says how it is spelt.
    pub of_dates: bool,
    /// Function that returns the change of a text that is spelt so by its first lines; `None` for any other.
    pub change: fn(&Look) -> Option<Respell>,
}

/// The text with its numbers as readers take them; `None` where it is not spelt so.
#[cfg(test)]
pub(super) fn respelt(spelling: &Spelling, text: &str) -> Option<String> {
    let change = (spelling.change)(&Look::at(text.as_bytes()))?;
    Some(crate::source::rewrite::changed_by(change, text))
}
