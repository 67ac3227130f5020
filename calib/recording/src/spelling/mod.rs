//! Numbers and stamps that programs spell in their own way, respelt line by line before anything else looks at a text.

mod cells;
mod comma_stamp;
mod grouped;
mod unit_cells;

use std::io::Read;

use crate::header::look::Look;

/// A change of a text that keeps its lines.
pub(crate) type Respell = Box<dyn FnOnce(Box<dyn Read + Send>) -> Box<dyn Read + Send>>;

/// A way to spell numbers.
#[derive(Debug)]
pub(crate) struct Spelling {
    /// What is spelt so, in a remark.
    pub spelling: &'static str,
    /// What it is read as.
    pub read_as: &'static str,
    /// Function that returns the change of a text that is spelt so by its first lines; `None` for any other.
    pub change: fn(&Look) -> Option<Respell>,
}

/// Every way; what one respells the next one sees.
pub(crate) static SPELLINGS: [&Spelling; 3] = [
    &comma_stamp::COMMA_STAMP,
    &unit_cells::UNIT_CELLS,
    &grouped::GROUPED,
];

/// True for a number with a unit behind it.
pub(crate) fn is_number_with_unit(cell: &[u8]) -> bool {
    let text = std::str::from_utf8(cell).ok();
    text.is_some_and(|text| unit_cells::number_and_unit(text).is_some())
}

#[cfg(test)]
fn respelt(spelling: &Spelling, text: &str) -> Option<String> {
    let change = (spelling.change)(&Look::at(text.as_bytes()))?;
    let mut changed = String::new();
    let read = change(Box::new(std::io::Cursor::new(text.to_owned())));
    { read }.read_to_string(&mut changed).ok()?;
    Some(changed)
}
