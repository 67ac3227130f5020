//! A text read line by line into another with the same lines.

use std::io::{self, BufRead, BufReader, Read};

use super::batches::is_too_long;

/// A reader of the lines that `change` makes of those of another.
pub(crate) struct Rewritten<F> {
    source: BufReader<Box<dyn Read + Send>>,
    change: F,
    line: Vec<u8>,
    out: Vec<u8>,
    at: usize,
}

/// The text whose lines, without their ends, `change` writes behind what its second argument holds.
pub(crate) fn rewritten<F>(source: Box<dyn Read + Send>, change: F) -> Box<dyn Read + Send>
where
    F: FnMut(&[u8], &mut Vec<u8>) + Send + 'static,
{
    Box::new(Rewritten {
        source: BufReader::with_capacity(64 << 10, source),
        change,
        line: Vec::new(),
        out: Vec::new(),
        at: 0,
    })
}

impl<F: FnMut(&[u8], &mut Vec<u8>)> Rewritten<F> {
    /// Makes the next line; false at the end.
    fn next(&mut self) -> io::Result<bool> {
        self.line.clear();
        self.out.clear();
        self.at = 0;
        loop {
            let buffer = self.source.fill_buf()?;
            let end = memchr::memchr2(b'\n', b'\r', buffer);
            let length = end.map_or(buffer.len(), |at| at + 1);
            self.line.extend_from_slice(&buffer[..length]);
            self.source.consume(length);
            if end.is_some() || length == 0 || is_too_long(self.line.len()) {
                break;
            }
        }
        // A return before a feed is one end of a line with it.
        if self.line.ends_with(b"\r") && self.source.fill_buf()?.starts_with(b"\n") {
            self.line.push(b'\n');
            self.source.consume(1);
        }
        let content = self.line.trim_ascii_end().len();
        // Blanks before the end of the line are no part of it.
        let end = self.line.iter().rposition(|b| !matches!(b, b'\r' | b'\n'));
        let end = end.map_or(0, |at| at + 1);
        (self.change)(&self.line[..content], &mut self.out);
        self.out.extend_from_slice(&self.line[end..]);
        Ok(!self.line.is_empty())
    }
}

impl<F: FnMut(&[u8], &mut Vec<u8>)> Read for Rewritten<F> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.at == self.out.len() && !buffer.is_empty() {
            if !self.next()? {
                return Ok(0);
            }
        }
        let length = buffer.len().min(self.out.len() - self.at);
        buffer[..length].copy_from_slice(&self.out[self.at..self.at + length]);
        self.at += length;
        Ok(length)
    }
}

/// The text that `change` makes of another.
#[cfg(test)]
pub(crate) fn changed_by(
    change: impl FnOnce(Box<dyn Read + Send>) -> Box<dyn Read + Send>,
    text: &str,
) -> String {
    let text = io::Cursor::new(text.to_owned());
    io::read_to_string(change(Box::new(text))).unwrap()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_their_ends_stay() {
        let text = b"a 1\r\nskipped\n\nb 2".to_vec();
        let mut read = rewritten(Box::new(io::Cursor::new(text)), |line, out| {
            if line.contains(&b' ') {
                out.extend(line.iter().rev());
            }
        });
        let mut all = String::new();
        read.read_to_string(&mut all).unwrap();
        assert_eq!(all, "1 a\r\n\n\n2 b");
        // Returns end lines too.
        let upper = |text: &str| {
            changed_by(
                |text| {
                    let change = |line: &[u8], out: &mut Vec<u8>| {
                        out.push(b'>');
                        out.extend_from_slice(line);
                    };
                    rewritten(text, change)
                },
                text,
            )
        };
        assert_eq!(upper("a\rb\r\nc\n\rd"), ">a\r>b\r\n>c\n>\r>d");
    }
}
