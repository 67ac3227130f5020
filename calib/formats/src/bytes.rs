//! Bytes in order, little endian, with their place.

use std::io::{self, BufRead, Read};

use findings::{Finding, Kind};

use crate::error::counted;
use crate::{Error, Limits};

/// A stream of bytes that is read forward.
pub(crate) struct Bytes<'a> {
    reader: &'a mut dyn Read,
    buffer: Vec<u8>,
    /// First byte of the buffer that has not been taken.
    from: usize,
    /// Bytes taken.
    at: u64,
    limit: u64,
    ended: bool,
    /// Bytes asked from the reader next time.
    ask: usize,
}

/// Bytes asked from the reader at a time: little of a short file, whose buffer would cost more than its content.
const FIRST_CHUNK: usize = 8 << 10;
const CHUNK: usize = 64 << 10;

impl<'a> Bytes<'a> {
    pub fn new(reader: &'a mut dyn Read, limits: Limits) -> Self {
        Self {
            reader,
            buffer: Vec::new(),
            from: 0,
            at: 0,
            limit: limits.bytes,
            ended: false,
            ask: FIRST_CHUNK,
        }
    }

    /// Bytes taken so far.
    pub fn at(&self) -> u64 {
        self.at
    }

    /// The next `length` bytes; `None` where the file ends before. Memory grows with what there is, not with
    /// what is asked for.
    pub fn take(&mut self, length: u64) -> Result<Option<&[u8]>, Error> {
        if length > self.limit {
            return Err(Error::at(
                self.at,
                counted(Finding::of(Kind::PIECE_TOO_LONG), "bytes", length),
            ));
        }
        let length = length as usize;
        if !self.fill(length)? {
            return Ok(None);
        }
        let start = self.from;
        self.from += length;
        self.at += length as u64;
        Ok(self.buffer.get(start..start + length))
    }

    /// The next `length` bytes as they come, without holding them.
    pub fn part(&mut self, length: u64) -> Part<'_, 'a> {
        Part {
            bytes: self,
            left: length,
        }
    }

    /// The next bytes, up to `length`, without taking them.
    pub fn peek(&mut self, length: usize) -> Result<&[u8], Error> {
        self.fill(length)?;
        let end = self.buffer.len().min(self.from + length);
        Ok(&self.buffer[self.from..end])
    }

    /// True once `length` bytes are in the buffer.
    fn fill(&mut self, length: usize) -> Result<bool, Error> {
        if self.buffer.len() - self.from >= length {
            return Ok(true);
        }
        self.buffer.drain(..self.from);
        self.from = 0;
        while self.buffer.len() < length && !self.ended {
            let old = self.buffer.len();
            self.buffer.resize(old + self.ask, 0);
            let read = loop {
                match self.reader.read(&mut self.buffer[old..]) {
                    Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                    other => break other,
                }
            };
            self.buffer
                .truncate(old + read.as_ref().map_or(0, |read| *read));
            let read = read?;
            self.ended = read == 0;
            if read == self.ask {
                self.ask = CHUNK.min(2 * self.ask);
            }
        }
        Ok(self.buffer.len() >= length)
    }
}

/// A part of a stream of bytes.
pub(crate) struct Part<'b, 'a> {
    bytes: &'b mut Bytes<'a>,
    left: u64,
}

impl Part<'_, '_> {
    /// Passes what was not read; false where the stream ends before.
    pub fn pass(mut self) -> Result<bool, Error> {
        io::copy(&mut self, &mut io::sink())?;
        Ok(self.left == 0)
    }
}

impl BufRead for Part<'_, '_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        let most = self.left.min(CHUNK as u64) as usize;
        let bytes = &mut *self.bytes;
        bytes.fill(usize::from(most > 0)).map_err(io::Error::from)?;
        let end = bytes.buffer.len().min(bytes.from + most);
        Ok(&bytes.buffer[bytes.from..end])
    }

    fn consume(&mut self, length: usize) {
        self.bytes.from += length;
        self.bytes.at += length as u64;
        self.left -= length as u64;
    }
}

impl Read for Part<'_, '_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let there = self.fill_buf()?;
        let length = there.len().min(buffer.len());
        buffer[..length].copy_from_slice(&there[..length]);
        self.consume(length);
        Ok(length)
    }
}

/// Fields of a record, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fields<'a>(pub &'a [u8]);

macro_rules! number {
    ($($name:ident: $type:ty),*) => {
        $(#[inline]
        #[allow(dead_code)]
        pub fn $name(&mut self) -> Option<$type> {
            const SIZE: usize = std::mem::size_of::<$type>();
            let (bytes, rest) = self.0.split_first_chunk::<SIZE>()?;
            self.0 = rest;
            Some(<$type>::from_le_bytes(*bytes))
        })*
    };
}

impl<'a> Fields<'a> {
    number!(u8: u8, i8: i8, u16: u16, i16: i16, u32: u32, i32: i32, u64: u64, i64: i64, f32: f32, f64: f64);

    /// The next `length` bytes.
    pub fn bytes(&mut self, length: usize) -> Option<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(bytes)
    }

    /// Bytes behind their length in 32 bits.
    pub fn block(&mut self) -> Option<&'a [u8]> {
        let length = self.u32()?;
        self.bytes(length as usize)
    }

    /// The same as text.
    pub fn text(&mut self) -> Option<String> {
        Some(String::from_utf8_lossy(self.block()?).into_owned())
    }
}
