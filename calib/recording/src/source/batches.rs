//! A text in batches of whole lines, however its bytes come in.

use std::io::{ErrorKind, Read};
use std::ops::Range;

use findings::{Finding, Kind};
use memchr::{memchr, memrchr, memrchr2};

/// Bytes asked from the reader at a time: little of a short text, whose buffer would cost more than its content.
const FIRST_CHUNK: usize = 8 << 10;
const CHUNK: usize = 256 << 10;
/// Bytes of a batch, give or take a chunk.
const BATCH: usize = 1 << 20;
/// Parts of a batch that threads share out among themselves.
const PIECES: usize = 16;
/// No line of a recording is longer.
const LONGEST_LINE: usize = 1 << 20;

/// Whole lines of a text.
#[derive(Debug, Default)]
pub struct Batch {
    /// The lines; only the last of the text may lack its end.
    pub bytes: Vec<u8>,
    /// Bytes of them that are parsed at a time.
    pub piece: usize,
    /// Bytes of the text before them.
    before: u64,
    /// Position in the text of the first NUL byte met.
    nul: Option<u64>,
}

impl Batch {
    /// All of a text in memory.
    pub fn of(text: &[u8]) -> Self {
        Self {
            bytes: text.to_vec(),
            piece: text.len(),
            before: 0,
            nul: memchr(0, text).map(|at| at as u64),
        }
    }

    /// True if there are bytes in it that no text has.
    pub fn is_binary(&self) -> bool {
        self.nul.is_some()
    }

    /// Returns the finding about a `line` that is binary or too long.
    pub fn fault(&self, line: &Range<usize>) -> Option<Finding> {
        match self.nul {
            Some(nul) if nul < self.before + line.end as u64 => {
                Some(Finding::of(Kind::BINARY_DATA).count("at_byte", nul as usize))
            }
            _ if is_too_long(line.len()) => Some(Finding::of(Kind::LINE_TOO_LONG)),
            _ => None,
        }
    }
}

/// True for a number of bytes that no line of a recording has.
pub(crate) fn is_too_long(line: usize) -> bool {
    line > LONGEST_LINE
}

/// Why there are no more batches.
#[derive(Debug)]
pub enum Stop {
    /// The text ended.
    End,
    /// The line after the last one is at fault, for this reason.
    Line(Box<Finding>),
    /// The text is at fault, for this reason.
    Text(Box<Finding>),
}

/// Batches of a text.
#[derive(Debug)]
pub struct Batches<R> {
    reader: R,
    max_bytes: u64,
    size: usize,
    /// Bytes asked from the reader next time.
    ask: usize,
    /// The beginning of the line after the last batch.
    rest: Vec<u8>,
    /// Bytes in the batches so far.
    before: u64,
    nul: Option<u64>,
    stop: Option<Stop>,
}

impl<R: Read> Batches<R> {
    /// Batches of `reader`; stops at a text of more than `max_bytes`.
    pub fn new(reader: R, max_bytes: u64) -> Self {
        Self {
            reader,
            max_bytes,
            size: BATCH,
            ask: FIRST_CHUNK,
            rest: Vec::new(),
            before: 0,
            nul: None,
            stop: None,
        }
    }

    /// The same in batches of about `size` bytes.
    #[cfg(test)]
    pub fn in_size(self, size: usize) -> Self {
        Self { size, ..self }
    }

    /// The next batch, in the memory of `bytes` and never without a line; `None` where there are no
    /// more, for the reason that [`Batches::stop`] gives.
    pub fn next(&mut self, mut bytes: Vec<u8>) -> Option<Batch> {
        bytes.clear();
        bytes.append(&mut self.rest);
        let end = loop {
            if bytes.len() >= self.size || self.stop.is_some() {
                if let Some(end) = self.end_of_lines(&bytes) {
                    break end;
                }
                if self.stop.is_some() {
                    return None;
                }
                if is_too_long(bytes.len()) {
                    self.stop = Some(Stop::Line(Finding::of(Kind::LINE_TOO_LONG).into()));
                    return None;
                }
            }
            self.fill(&mut bytes);
        };
        self.rest.extend_from_slice(&bytes[end..]);
        bytes.truncate(end);
        let before = self.before;
        self.before += end as u64;
        Some(Batch {
            bytes,
            piece: self.size / PIECES,
            before,
            nul: self.nul,
        })
    }

    /// Why there are no more batches.
    pub fn stop(self) -> Stop {
        self.stop.unwrap_or(Stop::End)
    }

    /// Returns the end of the last whole line of `bytes`; at the end of the text, the end of `bytes`.
    fn end_of_lines(&self, bytes: &[u8]) -> Option<usize> {
        if matches!(self.stop, Some(Stop::End)) {
            return Some(bytes.len()).filter(|&end| end > 0);
        }
        let feed = memrchr(b'\n', bytes);
        // A CR in last place may be half of a CRLF.
        let half = self.stop.is_none() && bytes.ends_with(b"\r");
        let complete = &bytes[..bytes.len() - usize::from(half)];
        let end = feed.or_else(|| memrchr2(b'\n', b'\r', complete));
        end.map(|at| at + 1)
    }

    /// Reads a chunk behind `bytes`, or sets the reason why there is none.
    fn fill(&mut self, bytes: &mut Vec<u8>) {
        let old = bytes.len();
        let ask = self.ask.min(self.size);
        bytes.resize(old + ask, 0);
        let read = loop {
            match self.reader.read(&mut bytes[old..]) {
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                other => break other,
            }
        };
        bytes.truncate(old + read.as_ref().map_or(0, |&read| read));
        match read {
            Err(error) => {
                let stopped = Finding::of(Kind::READING_STOPPED);
                let stopped = stopped.detail("reason", error.to_string());
                self.stop = Some(Stop::Line(stopped.into()));
            }
            Ok(0) => self.stop = Some(Stop::End),
            Ok(read) if read == self.ask => self.ask = CHUNK.min(2 * self.ask),
            Ok(_) => {}
        }
        if self.before + bytes.len() as u64 > self.max_bytes {
            let found = Finding::of(Kind::TOO_MANY_BYTES)
                .count("limit", self.max_bytes as usize)
                .detail("what", "text");
            self.stop = Some(Stop::Text(found.into()));
            bytes.truncate(old);
        }
        if self.nul.is_none() {
            let at = memchr(0, &bytes[old..]);
            self.nul = at.map(|at| self.before + (old + at) as u64);
        }
    }
}
