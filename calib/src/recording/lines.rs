//! Text as numbered lines, one buffer long.
//!
//! Recordings are numbers: no cell spans lines, so lines are found first and cells within them. That
//! keeps line numbers right for LF, CRLF, bare CR and any mixture, whatever comments or quotes there
//! are.

use std::io::Read;

use memchr::{memchr, memchr2};

use super::place::{at_line, in_file};
use crate::Error;

/// Bytes asked from the reader at a time.
const CHUNK: usize = 256 << 10;
/// No line of a recording is longer.
const LONGEST_LINE: usize = 1 << 20;

/// One line without its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// Number, from 1.
    pub number: u64,
    /// Content.
    pub bytes: &'a [u8],
}

/// Lines of a text.
pub(super) struct Lines<R> {
    name: String,
    reader: R,
    buffer: Vec<u8>,
    start: usize,
    /// Bytes of the text before `buffer[0]`.
    before: u64,
    /// Position in the text of the first NUL byte met.
    nul: Option<u64>,
    number: u64,
    after_cr: bool,
    exhausted: bool,
    max_bytes: u64,
}

impl<R: Read> Lines<R> {
    /// Lines of `reader`, which messages call `name`; refuses more than `max_bytes`.
    pub fn new(name: &str, reader: R, max_bytes: u64) -> Self {
        Self {
            name: name.to_owned(),
            reader,
            buffer: Vec::new(),
            start: 0,
            before: 0,
            nul: None,
            number: 0,
            after_cr: false,
            exhausted: false,
            max_bytes,
        }
    }

    /// The next line, `None` at the end.
    pub fn next(&mut self) -> Result<Option<Line<'_>>, Error> {
        let mut searched = 0;
        let found = loop {
            if self.after_cr && self.start < self.buffer.len() {
                self.after_cr = false;
                self.start += usize::from(self.buffer[self.start] == b'\n');
            }
            let rest = self.buffer.get(self.start + searched..).unwrap_or_default();
            if let Some(at) = memchr2(b'\n', b'\r', rest) {
                break Some(self.start + searched + at);
            }
            searched += rest.len();
            if self.exhausted {
                break None;
            }
            if searched > LONGEST_LINE {
                return Err(at_line(
                    &self.name,
                    self.number + 1,
                    "a line of more than 1 MiB: this is no recording in text",
                ));
            }
            self.fill()?;
        };
        let end = found.unwrap_or(self.buffer.len());
        if found.is_none() && self.start >= end {
            return Ok(None);
        }
        self.number += 1;
        self.refuse_nul(end)?;
        let begin = self.start;
        self.after_cr = self.buffer.get(end) == Some(&b'\r');
        self.start = end + usize::from(found.is_some());
        Ok(Some(Line {
            number: self.number,
            bytes: &self.buffer[begin..end],
        }))
    }

    /// Moves the unfinished line to the front and reads a chunk behind it.
    fn fill(&mut self) -> Result<(), Error> {
        self.buffer.drain(..self.start);
        self.before += self.start as u64;
        self.start = 0;
        let old = self.buffer.len();
        self.buffer.resize(old + CHUNK, 0);
        let read = loop {
            match self.reader.read(&mut self.buffer[old..]) {
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                other => break other,
            }
        };
        let read = read.map_err(|error| {
            let line = self.number + 1;
            at_line(&self.name, line, format!("reading stopped here: {error}"))
        })?;
        self.buffer.truncate(old + read);
        self.exhausted = read == 0;
        let total = self.before + self.buffer.len() as u64;
        if total > self.max_bytes {
            let limit = self.max_bytes;
            return Err(in_file(
                &self.name,
                format!("more than {limit} bytes of text; --max-bytes raises the limit"),
            ));
        }
        if self.nul.is_none() {
            let at = memchr(0, &self.buffer[old..]);
            self.nul = at.map(|at| self.before + (old + at) as u64);
        }
        Ok(())
    }

    fn refuse_nul(&self, end: usize) -> Result<(), Error> {
        match self.nul {
            Some(nul) if nul < self.before + end as u64 => {
                let words = format!("binary data at byte {nul}: truncated or wrong format?");
                Err(at_line(&self.name, self.number, words))
            }
            _ => Ok(()),
        }
    }
}
