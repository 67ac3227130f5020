//! Text as numbered lines.
//!
//! Recordings are numbers: no cell spans lines, so lines are found first and cells within them. That
//! keeps line numbers right for LF, CRLF, bare CR and any mixture, whatever comments or quotes there
//! are.

use std::ops::Range;

use memchr::memchr2;

/// One line without its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    /// Number, from 1.
    pub number: u64,
    /// Content.
    pub bytes: &'a [u8],
    /// Text after the line, as far as it has been read; empty behind the last line.
    pub below: &'a [u8],
    /// It has a line end.
    pub ended: bool,
}

/// Returns the byte ranges of the lines of `text` from `start` on, without their ends; the last line may lack its end.
pub(crate) fn lines(text: &[u8], start: usize) -> impl Iterator<Item = Range<usize>> {
    let mut start = start;
    std::iter::from_fn(move || {
        let rest = text.get(start..).filter(|rest| !rest.is_empty())?;
        let length = memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let line = start..start + length;
        start = line.end + end_of_line(&rest[length..]);
        Some(line)
    })
}

/// Bytes of the line end that `text` begins with: 2 for CRLF, 1 for LF or CR, else 0.
#[inline]
pub(crate) fn end_of_line(text: &[u8]) -> usize {
    match text {
        [b'\r', b'\n', ..] => 2,
        [b'\n' | b'\r', ..] => 1,
        _ => 0,
    }
}
